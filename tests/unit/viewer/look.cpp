#include <gtest/gtest.h>

#include "tests/support/SettingTexts.h"
#include "viewer/session/State.h"

namespace tessera::viewer {
namespace {

using engine::Technique;

Look lookOf(Technique technique, std::optional<int> tilePixels = {}, int samples = 1) {
    Look look;
    look.technique = technique;
    look.settings.culling.tilePixels = tilePixels;
    look.settings.samples = samples;
    return look;
}

TEST(Look, aLookHoldsValuesThatItsTechniqueSupports) {
    for (const engine::TechniqueInfo& from : engine::techniqueTable()) {
        for (const engine::TechniqueInfo& to : engine::techniqueTable()) {
            for (const frame::DebugViewInfo& view : frame::debugViewTable()) {
                Look look = lookOf(to.technique, 32, 4);
                look.settings.culling.method = from.methods.front();
                look.settings.culling.builder = culling::Builder::Compute;
                look.settings.lightOn = frame::LightingStage::Compute;
                look.settings.view = view.view;
                const Look result = possible(look);
                EXPECT_NO_THROW(engine::requireSupported(result));
                EXPECT_TRUE(result.settings.samples == 1 || to.multisamples());
                EXPECT_EQ(possible(result), result);
            }
        }
    }
}

TEST(Look, valuesPutAsideReturnWithATechniqueThatSupportsThem) {
    Look look = lookOf(Technique::ForwardPlus, 32, 4);
    look.settings.culling.method = culling::Method::Tile25d;
    look.settings.culling.builder = culling::Builder::Compute;
    Look now = look;
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) {
        now.technique = info.technique;
        now = possible(now);
        Look wanted = look;
        wanted.technique = info.technique;
        EXPECT_EQ(requested(now), wanted) << info.name;
    }
    now.technique = look.technique;
    EXPECT_EQ(possible(now), look);
}

TEST(Look, aChoiceReplacesAValuePutAside) {
    Look look = possible(lookOf(Technique::Forward, 32));
    EXPECT_FALSE(look.settings.culling.tilePixels);
    look.technique = Technique::ForwardPlus;
    look.settings.culling.tilePixels = 8;
    EXPECT_EQ(possible(look).settings.culling.tilePixels, 8);
    EXPECT_EQ(requested(look).settings.culling.tilePixels, 8);
}

TEST(Look, valuesPutAsideAreNoChoiceForTheNextScene) {
    const Look before = lookOf(Technique::ForwardPlus, {}, 4);
    Look now = before;
    now.technique = Technique::Deferred;
    now = possible(now);
    Look result = rebased(now, before, lookOf(Look().technique, {}, 2));
    EXPECT_EQ(result.technique, Technique::Deferred);
    result.technique = Technique::ForwardPlus;
    EXPECT_EQ(possible(result).settings.samples, 2);
}

TEST(Look, choicesOfTheUserOverrideTheNextScenesOptions) {
    const Look before;
    Look now = lookOf(Technique::ForwardPlus), chosen = lookOf(Technique::Deferred);
    now.settings.exposureEV = 1.5f;
    chosen.settings.exposureEV = -3.0f;
    chosen.settings.toneMap = frame::ToneMap::Aces;
    const Look result = rebased(now, before, chosen);
    EXPECT_EQ(result.technique, Technique::ForwardPlus);
    EXPECT_EQ(result.settings.exposureEV, 1.5f);
    EXPECT_EQ(result.settings.toneMap, frame::ToneMap::Aces);
}

TEST(Look, everySettingThatNamesNothingOfAnotherSceneOutlivesIt) {
    const scenes::Scene scene = tessera::test::sceneOfTwoCameras();
    for (const engine::Setting& setting : engine::settingTable()) {
        Look before, now;
        before.technique = now.technique = Technique::ClusteredDeferred;
        setting.value.copy(now, tessera::test::changedIn(setting, scene));
        const Look result = requested(rebased(now, before, before));
        EXPECT_EQ(result, setting.isOfScene ? before : requested(possible(now))) << setting.name;
    }
}

TEST(Look, theSidesOfAComparisonShareTheSettingsThatTheTableMarks) {
    const scenes::Scene scene = tessera::test::sceneOfTwoCameras();
    for (const engine::Setting& setting : engine::settingTable()) {
        State state;
        state.compare = Compare::Split;
        state.activeSide = 1;
        setting.value.copy(state.looks[1], tessera::test::changedIn(setting, scene));
        state.shareSettings();
        EXPECT_FALSE(setting.isDefault(state.looks[1])) << setting.name;
        EXPECT_EQ(setting.isDefault(state.looks[0]), !setting.isShared) << setting.name;
    }
    const auto isShared = [](const char* key) { return engine::settingOf(key).isShared; };
    for (const char* key : {"camera", "time", "solo", "exposureEV", "toneMap"}) EXPECT_TRUE(isShared(key)) << key;
    for (const char* key : {"technique", "layout", "culling", "view", "filter"}) EXPECT_FALSE(isShared(key)) << key;
}

} // namespace
} // namespace tessera::viewer
