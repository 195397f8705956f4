#include "renderer/frame/RefineLayout.h"

#include <gtest/gtest.h>

#include "scenes/InUse.h"
#include "scenes/Load.h"
#include "tests/support/Sweep.h"
#include "tests/support/TestScenes.h"

namespace tessera::frame {
namespace {

using scenes::Material;
using scenes::MaterialModel;
using scenes::Scene;

/// A quad with a material of this model and without vertex colours.
Scene quadOf(MaterialModel model) {
    Material material;
    material.model = model;
    return test::quadScene(material);
}

/// Whether albedo and specular of the packed layout stay packed.
std::pair<bool, bool> packed(const Scene& scene) {
    const GBufferLayout layout = refined(layoutTable()[1].layout, scene);
    return {layout[Channel::Albedo] == Encoding::Packed, layout[Channel::Specular] == Encoding::Packed};
}

TEST(RefineLayout, aChannelIsExactOnlyWhereAColourMayExceedItsField) {
    Scene scene = quadOf(MaterialModel::Microfacet);
    scene.materials[0].baseColor = glm::vec4(1.0f);
    scene.materials[0].specularColor = glm::vec3(1.0f);
    EXPECT_EQ(packed(scene), std::pair(true, true));
    scene.materials[0].baseColor.b = 1.01f;
    EXPECT_EQ(packed(scene), std::pair(false, true));
    scene.materials[0].model = MaterialModel::SingleColor; // its colour is radiance
    EXPECT_EQ(packed(scene), std::pair(true, true));
    scene.materials[0].model = MaterialModel::BlinnPhong;
    scene.materials[0].baseColor.b = 1.0f;
    scene.materials[0].specularColor.g = 1.5f;
    EXPECT_EQ(packed(scene), std::pair(true, false));
    scene.materials[0].model = MaterialModel::MetallicRoughness; // its F0 is clamped to 1
    EXPECT_EQ(packed(scene), std::pair(true, true));
    scene.meshes[0].colors.assign(4, glm::vec4(1.0f, 2.0f, 1.0f, 1.0f));
    EXPECT_EQ(packed(scene), std::pair(false, true));
}

TEST(RefineLayout, whatAFilmReflectsIsExactWhereItIsStored) {
    Scene scene = test::quadScene({});
    scene.materials[0].iridescence = 0.5f;
    EXPECT_EQ(packed(scene), std::pair(true, false));
    scene.materials[0].transmission = 0.5f;
    EXPECT_EQ(packed(scene), std::pair(true, true)) << "drawn on top";
    scene.materials[0].transmission = 0.0f;
    scene.materials[0].iridescenceThicknessNm = 0.0f;
    EXPECT_EQ(packed(scene), std::pair(true, true)) << "no film";
}

TEST(RefineLayout, theNormalOfSlimIsThatOfPackedExactlyWhereAMaterialMasksByTheHalfVector) {
    Scene scene = quadOf(MaterialModel::Microfacet);
    scene.materials[0].masking = scenes::Masking::HalfVector;
    const GBufferLayout& slim = layoutTable()[2].layout;
    GBufferLayout wanted = slim;
    wanted.encoding[std::size_t(Channel::Normal)] = Encoding::Packed;
    EXPECT_EQ(refined(slim, scene), wanted);
    ASSERT_EQ(refinements(slim, scene).size(), 1u);
    EXPECT_EQ(refinements(slim, scene)[0].channel, Channel::Normal);
    for (const std::size_t finer : {0u, 1u})
        EXPECT_EQ(refined(layoutTable()[finer].layout, scene), layoutTable()[finer].layout);
    scene.materials[0].masking = scenes::Masking::Walter;
    EXPECT_EQ(refined(slim, scene), slim);
    scene.materials[0].masking = scenes::Masking::HalfVector;
    scene.materials[0].model = MaterialModel::MetallicRoughness; // has no such option
    EXPECT_EQ(refined(slim, scene), slim);
}

TEST(RefineLayout, theAlphasOfSlimAreThoseOfPackedWhereAHighlightIsAStreakAndSoIsTheNormalOfAThinOne) {
    Scene scene = quadOf(MaterialModel::MicrofacetAnisotropic);
    scene.materials[0].alpha = 0.5f;
    scene.materials[0].alphaY = 0.2f;
    const GBufferLayout& slim = layoutTable()[2].layout;
    GBufferLayout wanted = slim;
    for (const Channel channel : {Channel::Microsurface, Channel::Tangent})
        wanted.encoding[std::size_t(channel)] = Encoding::Packed;
    EXPECT_EQ(refined(slim, scene), wanted);
    EXPECT_EQ(refined(layoutTable()[1].layout, scene), layoutTable()[1].layout);
    wanted.encoding[std::size_t(Channel::Normal)] = Encoding::Packed;
    scene.materials[0].alphaY = 0.05f;
    EXPECT_EQ(refined(slim, scene), wanted);
    scene.materials[0].alphaY = 0.2f;
    scene.materials[0].texture(scenes::TextureSlot::Anisotropy).image = 0;
    EXPECT_EQ(refined(slim, scene), wanted) << "its texture may make it thinner";
    scene.materials[0].texture(scenes::TextureSlot::Anisotropy).image = scenes::kNone;
    scene.materials[0].alphaMode = scenes::AlphaMode::Blend;
    EXPECT_EQ(refined(slim, scene), slim) << "drawn on top";
    scene.materials[0] = {};
    EXPECT_EQ(refined(slim, scene), slim);
}

/// Checks each built-in scene; a reduced sweep takes every other one, which covers all families.
void expectRefinementsOfBuiltinScenes() {
    scenes::LoadOptions options;
    options.useAssets = false; // ignores scans that may be installed
    std::size_t turn = 0;
    for (const scenes::BuiltinScene& builtin : scenes::builtinScenes()) {
        if (!test::isWholeSweep() && turn++ % 2 != 0) continue;
        SCOPED_TRACE(builtin.name);
        const Scene scene = scenes::loadScene(std::string(builtin.name), options);
        const std::size_t ofDiffusedLight = scenes::anyDiffuses(scene, {}) ? 1 : 0;
        for (const Refinement& refinement : refinements(layoutTable()[1].layout, scene))
            EXPECT_EQ(refinement.channel, Channel::Emission);
        EXPECT_EQ(refinements(layoutTable()[1].layout, scene).size(), ofDiffusedLight);
        // Anisotropic highlights: both channels of alphas; in "models" also the normal.
        const std::size_t ofHighlights = builtin.name == "models" ? 3 : builtin.name == "studio" ? 2 : 0;
        EXPECT_EQ(refinements(layoutTable()[2].layout, scene).size(), ofDiffusedLight + ofHighlights);
        // Nothing is diffused if another method is requested.
        EXPECT_TRUE(refinements(layoutTable()[1].layout, scene, scenes::SubsurfaceMethod::Wrap).empty());
    }
}
TEST(RefineLayout, builtinScenesNeedMoreThanTheirLayoutForTheHalfVectorOfModelsAndDiffusedLightAlone) {
    expectRefinementsOfBuiltinScenes();
}
TEST(RefineLayoutSlow, builtinScenesNeedMoreThanTheirLayoutForTheHalfVectorOfModelsAndDiffusedLightAlone) {
    expectRefinementsOfBuiltinScenes();
}

} // namespace
} // namespace tessera::frame
