#include "validation/compare/TechniqueCompare.h"

#include <gtest/gtest.h>

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
    frame::FrameSettings asked;
    asked.lightOn = frame::LightingStage::Compute;
    asked.culling = {culling::Method::Cluster, 32, culling::Builder::Compute, {}, {}};
    asked.exposureEV = 2.0f;
    const frame::FrameSettings forward = settingsTakenBy(Technique::Forward, asked);
    EXPECT_EQ(forward.lightOn, frame::FrameSettings().lightOn);
    EXPECT_EQ(forward.culling, culling::Settings());
    EXPECT_EQ(forward.exposureEV, 2.0f) << "which is no setting of how the picture is made";
    EXPECT_EQ(settingsTakenBy(Technique::ClusteredDeferred, asked), asked);
    for (const engine::Setting& setting : engine::settingTable()) {
        const bool isHow = setting.key == "culling" || setting.key == "tile" || setting.key == "cullOn" ||
                           setting.key == "cullNormals" || setting.key == "lightOn";
        EXPECT_EQ(setting.samePicture, isHow) << setting.name;
    }
}

} // namespace
} // namespace tessera::validation
