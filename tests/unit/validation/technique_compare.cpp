#include "validation/compare/TechniqueCompare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/TestScenes.h"
#include "validation/compare/LongestSpan.h"

namespace tessera::validation {
namespace {

using engine::Technique;

const frame::GBufferLayout kExact = frame::exactLayout().layout;

TEST(TechniqueCompare, pairsOnSoftwareAreHeldToEveryBit) {
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) {
        const Tolerance tolerance = pairTolerance(info.technique, kExact, true, 65536);
        EXPECT_EQ(tolerance.bitEqual, 1.0) << info.name;
        EXPECT_EQ(tolerance.maxRel, 0.0) << info.name;
    }
}

TEST(TechniqueCompare, onHardwareSumsByBlendingAreHeldToExactlyTheBoundOfTheirNumberOfTerms) {
    EXPECT_EQ(pairTolerance(Technique::DeferredVolumes, kExact, false, 31).maxRel, 1e-5);
    EXPECT_EQ(pairTolerance(Technique::DeferredVolumes, kExact, false, 4096).maxRel, 0x1p-12);
    EXPECT_EQ(pairTolerance(Technique::Deferred, kExact, false, 4096).maxRel, 1e-5);
    EXPECT_NE(pairTolerance(Technique::DeferredVolumes, kExact, false, 4096).reason,
              pairTolerance(Technique::Deferred, kExact, false, 4096).reason);
}

TEST(TechniqueCompare, settingsOfHowAPictureIsMadeGoToTheTechniquesThatTakeThem) {
    frame::FrameSettings requested;
    requested.lightOn = frame::LightingStage::Compute;
    requested.culling = {culling::Method::Cluster, 32, culling::Builder::Compute, {}, {}};
    requested.exposureEV = 2.0f;
    const frame::FrameSettings forward = supportedSettings(Technique::Forward, requested);
    EXPECT_EQ(forward.lightOn, frame::FrameSettings().lightOn);
    EXPECT_EQ(forward.culling, culling::Settings());
    EXPECT_EQ(forward.exposureEV, 2.0f) << "which is no setting of how the picture is made";
    EXPECT_EQ(supportedSettings(Technique::ClusteredDeferred, requested), requested);
    for (const engine::Setting& setting : engine::settingTable()) {
        const bool isHow = setting.key == "culling" || setting.key == "tile" || setting.key == "cullOn" ||
                           setting.key == "cullNormals" || setting.key == "lightOn";
        EXPECT_EQ(setting.samePicture, isHow) << setting.name;
    }
}

TEST(LongestSpan, theFarthestTriangleOrLightIsNamed) {
    scenes::Scene scene = test::quadScene({});
    EXPECT_EQ(longestSpan(scene), "triangle 0 of mesh '" + scene.meshes[0].name + "' at node '" + scene.nodes[0].name +
                                      "', which reaches 1.41 m from the origin");
    scenes::Light lamp = test::pointLight({0.0, 3.0, 4.0}, 1.0f);
    lamp.name = "bulb";
    lamp.radiusMetres = 1e6f;
    scene.lights = {lamp};
    EXPECT_EQ(longestSpan(scene), "light 0 'bulb', which reaches 1e+06 m from the origin");
    scene.meshes[0].positionsOS[3] *= 1e7f;
    EXPECT_THAT(longestSpan(scene), testing::HasSubstr("triangle "));
    scene.nodes[0].instances[0].castsShadow = false;
    EXPECT_THAT(longestSpan(scene), testing::StartsWith("light 0"));
    scene.lights[0].enabled = false;
    EXPECT_EQ(longestSpan(scene), "");
}

} // namespace
} // namespace tessera::validation
