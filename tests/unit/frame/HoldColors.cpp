#include "renderer/frame/HoldColors.h"

#include <gtest/gtest.h>

#include "scenes/Load.h"
#include "tests/support/TestScenes.h"

namespace tessera::frame {
namespace {

using scenes::Material;
using scenes::MaterialModel;
using scenes::Scene;

/// Whether albedo and specular of the packed layout stay packed.
std::pair<bool, bool> packed(const Scene& scene) {
    const GBufferLayout layout = holdingColors(layoutTable()[1].layout, scene);
    return {layout[Channel::Albedo] == Encoding::Packed, layout[Channel::Specular] == Encoding::Packed};
}

TEST(HoldColors, aChannelIsExactOnlyWhereAColourMayExceedItsField) {
    Material material;
    material.model = MaterialModel::Microfacet;
    material.baseColor = glm::vec4(1.0f);
    material.specularColor = glm::vec3(1.0f);
    Scene scene = test::quadScene(material);
    scene.meshes[0].colors.clear();
    EXPECT_EQ(packed(scene), std::pair(true, true));
    scene.materials[0].baseColor.b = 1.01f;
    EXPECT_EQ(packed(scene), std::pair(false, true));
    scene.materials[0].model = MaterialModel::SingleColor; // radiance
    EXPECT_EQ(packed(scene), std::pair(true, true));
    scene.materials[0].model = MaterialModel::BlinnPhong;
    scene.materials[0].baseColor.b = 1.0f;
    scene.materials[0].specularColor.g = 1.5f;
    EXPECT_EQ(packed(scene), std::pair(true, false));
    scene.materials[0].model = MaterialModel::MetallicRoughness; // its F0 is held to 1
    EXPECT_EQ(packed(scene), std::pair(true, true));
    scene.meshes[0].colors.assign(4, glm::vec4(1.0f, 2.0f, 1.0f, 1.0f));
    EXPECT_EQ(packed(scene), std::pair(false, true));
}

TEST(HoldColors, builtinScenesNeverNeedMoreThanTheirLayout) {
    for (const char* name : {"hall", "spheres", "models", "lattice", "room"})
        EXPECT_EQ(packed(scenes::loadScene(name)), std::pair(true, true)) << name;
}

} // namespace
} // namespace tessera::frame
