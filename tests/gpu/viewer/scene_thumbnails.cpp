// Every built-in scene has a thumbnail in the list of scenes.
#include "viewer/show/SceneThumbnails.h"

#include "scenes/Load.h"
#include "tests/support/GlContext.h"

namespace tessera::viewer {
namespace {

class SceneThumbnailsTest : public test::GlTest {};

TEST_F(SceneThumbnailsTest, everyBuiltInSceneHasAPicture) {
    SceneThumbnails thumbnails;
    const auto& textures = thumbnails.textures();
    for (const scenes::BuiltinScene& scene : scenes::builtinScenes())
        EXPECT_TRUE(textures.contains(scene.name)) << scene.name << ": draw it by tools/docs_pictures.py thumbnails";
    EXPECT_EQ(textures.size(), scenes::builtinScenes().size()) << "of scenes that are gone";
    EXPECT_EQ(&thumbnails.textures(), &textures);
}

} // namespace
} // namespace tessera::viewer
