#include "viewer/session/SceneSource.h"

#include <gmock/gmock.h>

#include "tests/unit/viewer/InEmptyFolder.h"

namespace tessera::viewer {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class SceneSource : public test::InEmptyFolder {
protected:
    static std::string here(const std::string& name) { return (std::filesystem::current_path() / name).string(); }
};

TEST_F(SceneSource, allPathsToAFileNameTheSameScene) {
    EXPECT_EQ(identityOf("a.gltf"), here("a.gltf"));
    EXPECT_EQ(identityOf("./x/../a.gltf"), here("a.gltf"));
    EXPECT_EQ(identityOf(here("a.gltf")), here("a.gltf"));
    EXPECT_EQ(identityOf("hall"), "hall");
    EXPECT_EQ(identityOf("./hall"), here("hall"));
}

TEST_F(SceneSource, aFileIsRecentOnce) {
    folder().write("a.gltf", "");
    folder().write("b.obj", "");
    std::vector<std::string> recent;
    noteRecent(recent, "a.gltf");
    noteRecent(recent, "b.obj");
    noteRecent(recent, here("./a.gltf"));
    EXPECT_THAT(recent, ElementsAre(here("a.gltf"), here("b.obj")));
}

TEST_F(SceneSource, onlySceneFilesAreRecent) {
    folder().write("hall/of/fame.txt", "");
    folder().write("room", "");
    folder().write("folder.glb/x", "");
    std::vector<std::string> recent;
    for (const char* source : {"hall", "room", "folder.glb", "missing.glb"}) noteRecent(recent, source);
    EXPECT_THAT(recent, IsEmpty());
}

} // namespace
} // namespace tessera::viewer
