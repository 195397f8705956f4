#include <gtest/gtest.h>

#include "viewer/session/Remember.h"

namespace tessera::viewer {
namespace {

using engine::Technique;
using Texts = decltype(Preferences::settings);

constexpr glm::ivec2 kWindow(900, 700);

/// A window with a look and its initial size.
State showing(const Look& look) {
    State state;
    state.looks = {look, look};
    state.firstWindowSize = kWindow;
    return state;
}

Preferences remembered() {
    Preferences preferences;
    preferences.windowSize = glm::ivec2(1000, 800);
    preferences.settings = {{"technique", "forward_plus"},
                            {"layout", "slim"},
                            {"culling", "tile_2.5d"},
                            {"toneMap", "agx"},
                            {"tile", "32"},
                            {"samples", "4"}};
    return preferences;
}

/// A look that differs from the defaults in all remembered settings, and in the exposure, which is not remembered.
Look ofItsOwn() {
    Look look;
    look.settings.exposureEV = 1.5f;
    look.technique = Technique::ForwardPlus;
    look.settings.toneMap = frame::ToneMap::Aces;
    look.settings.layout = frame::layoutTable().back().layout;
    look.settings.culling.method = culling::Method::TileMinmax;
    look.settings.culling.tilePixels = 64;
    look.settings.samples = 4;
    return look;
}

TEST(Remember, unchangedValuesDoNotChangeThePreferences) {
    for (const Look& begun : {Look(), ofItsOwn()}) { // set by the command line, or requested by the scene
        for (const Preferences& before : {Preferences(), remembered()}) {
            Preferences preferences = before;
            State state = showing(begun);
            recall(before, state);
            remember(preferences, state, begun, kWindow);
            EXPECT_EQ(preferences, before);
        }
    }
}

TEST(Remember, changedValuesAreRememberedByName) {
    for (const Preferences& before : {Preferences(), remembered()}) {
        Preferences preferences = before;
        remember(preferences, showing(ofItsOwn()), {}, {640, 480});
        EXPECT_EQ(preferences.settings, (Texts{{"technique", "forward_plus"},
                                               {"toneMap", "aces"},
                                               {"layout", std::string(frame::layoutTable().back().name)},
                                               {"culling", "tile_minmax"},
                                               {"tile", "64"},
                                               {"samples", "4"}}));
        EXPECT_EQ(preferences.windowSize, glm::ivec2(640, 480));
    }
}

TEST(Remember, rememberedValuesFollowTheLatestChoice) {
    Preferences preferences;
    preferences.settings["technique"] = "forward";
    Look begun;
    begun.technique = Technique::Forward;
    Look now = begun;
    now.technique = Technique::Deferred;
    remember(preferences, showing(now), begun, kWindow);
    EXPECT_EQ(preferences.settings.at("technique"), "deferred");
    Look open = ofItsOwn();
    open.settings.culling = {};
    open.settings.samples = 1;
    preferences = remembered();
    remember(preferences, showing(open), ofItsOwn(), kWindow);
    EXPECT_FALSE(preferences.settings.contains("culling")) << "it was left to the technique";
    EXPECT_FALSE(preferences.settings.contains("tile"));
    EXPECT_EQ(preferences.settings.at("samples"), "1");
}

TEST(Remember, commandLineValuesAreNotRemembered) {
    Preferences preferences = remembered();
    Look said = ofItsOwn();
    Look now = said;
    now.settings.toneMap = frame::ToneMap::None; // a choice of another value is remembered
    remember(preferences, showing(said), said, kWindow);
    EXPECT_EQ(preferences, remembered());
    remember(preferences, showing(now), said, kWindow);
    Preferences expected = remembered();
    expected.settings["toneMap"] = "none";
    EXPECT_EQ(preferences, expected);
}

TEST(Remember, valuesThatATechniqueDoesNotTakeStayInThePreferences) {
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) {
        Preferences preferences = remembered();
        const Look begun = possible(ofItsOwn());
        Look now = begun;
        now.technique = info.technique;
        remember(preferences, showing(possible(now)), begun, kWindow);
        Preferences expected = remembered();
        if (info.technique != begun.technique) expected.settings["technique"] = info.name;
        EXPECT_EQ(preferences, expected) << info.name;
    }
}

TEST(Remember, theWindowBeginsAsItWasLeft) {
    State left = showing({});
    left.recent = {"/a.glb"};
    left.automaticScale = false;
    left.fixedScale = 0.5f;
    left.showsPanel = false;
    left.showsMarkers = true;
    left.panelWidth = 400.0f;
    left.sections["Lights"] = true;
    Preferences preferences;
    remember(preferences, left, {}, kWindow);
    State next;
    recall(preferences, next);
    EXPECT_EQ(next.recent, left.recent);
    EXPECT_FALSE(next.automaticScale);
    EXPECT_EQ(next.fixedScale, 0.5f);
    EXPECT_FALSE(next.showsPanel);
    EXPECT_TRUE(next.showsMarkers);
    EXPECT_EQ(next.panelWidth, 400.0f);
    EXPECT_EQ(next.sections, left.sections);
}

} // namespace
} // namespace tessera::viewer
