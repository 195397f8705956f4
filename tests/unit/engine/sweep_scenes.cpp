// The built-in scenes of a reduced sweep cover the features of all built-in scenes.
#include <algorithm>
#include <bitset>

#include <gtest/gtest.h>

#include "engine/PrepareView.h"
#include "tests/support/Sweep.h"
#include "tests/support/TestScenes.h"

namespace tessera {
namespace {

std::bitset<frame::kFeatureCount> featuresInDeferred(const scenes::BuiltinScene& builtin) {
    scenes::LoadOptions options;
    options.useAssets = false;
    const scenes::Scene scene = test::builtinForSweep(builtin, options);
    frame::FrameSettings settings;
    settings.sizePixels = {96, 55};
    return engine::prepareView(scene, engine::Technique::Deferred, settings).spec.features.has;
}

/// Checks all scenes. A reduced sweep skips two busts, which are slow to make and have the features of the skin bust.
void expectFeatures() {
    std::bitset<frame::kFeatureCount> ofAll, ofTaken;
    std::size_t taken = 0;
    for (const scenes::BuiltinScene& builtin : scenes::builtinScenes()) {
        const bool isBust = builtin.name == "head" || builtin.name == "head_marble";
        if (!test::isWholeSweep() && isBust) continue;
        const std::bitset<frame::kFeatureCount> features = featuresInDeferred(builtin);
        ofAll |= features;
        if (!test::isTakenBySweep(builtin)) continue;
        ofTaken |= features;
        ++taken;
    }
    EXPECT_EQ(taken, 3u);
    const std::span<const frame::Feature> named = test::featuresThatNoBuiltinForSweepHas();
    for (const frame::FeatureInfo& info : frame::featureTable()) {
        const auto bit = static_cast<std::size_t>(info.feature);
        const bool isNamed = std::ranges::find(named, info.feature) != named.end();
        EXPECT_EQ(ofAll[bit] && !ofTaken[bit], isNamed) << info.what;
    }
}
TEST(SweepScenes, lackNoFeatureOfAnyBuiltinSceneButThoseThatTheyName) {
    expectFeatures();
}
TEST(SweepScenesSlow, lackNoFeatureOfAnyBuiltinSceneButThoseThatTheyName) {
    expectFeatures();
}

} // namespace
} // namespace tessera
