// The few built-in scenes that a sweep goes through unless it is a whole one stand for all of them.
#include <algorithm>
#include <bitset>

#include <gtest/gtest.h>

#include "engine/PrepareView.h"
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

TEST(SweepScenes, lackNoFeatureOfAnyBuiltinSceneButThoseThatTheyName) {
    std::bitset<frame::kFeatureCount> ofAll, ofTaken;
    for (const scenes::BuiltinScene& builtin : scenes::builtinScenes()) ofAll |= featuresInDeferred(builtin);
    const std::vector<scenes::BuiltinScene> takenScenes = test::builtinsForSweep();
    EXPECT_EQ(takenScenes.size(), 3u);
    for (const scenes::BuiltinScene& builtin : takenScenes) ofTaken |= featuresInDeferred(builtin);
    const std::span<const frame::Feature> named = test::featuresThatNoBuiltinForSweepHas();
    for (const frame::FeatureInfo& info : frame::featureTable()) {
        const auto bit = static_cast<std::size_t>(info.feature);
        const bool isNamed = std::ranges::find(named, info.feature) != named.end();
        EXPECT_EQ(ofAll[bit] && !ofTaken[bit], isNamed) << info.what;
    }
}

} // namespace
} // namespace tessera
