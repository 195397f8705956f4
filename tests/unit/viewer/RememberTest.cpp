#include <gtest/gtest.h>

#include "viewer/session/Remember.h"

namespace tessera::viewer {
namespace {

TEST(Remember, whatNobodyChangedIsNeverRemembered) {
    Look base;
    base.technique = recipes::Technique::ClusteredForward;
    base.settings.toneMap = frame::ToneMap::Agx;
    base.settings.layout = frame::layoutTable().back().layout;
    State state;
    state.looks = {base, base};
    Preferences preferences;
    remember(preferences, state, base);
    EXPECT_EQ(preferences, Preferences());
}

TEST(Remember, whatWasChangedIsAlwaysRememberedByName) {
    State state;
    Look& look = state.looks[0];
    look.technique = recipes::Technique::ForwardPlus;
    look.settings.toneMap = frame::ToneMap::Aces;
    look.settings.layout = frame::layoutTable().back().layout;
    look.settings.culling.method = culling::Method::TileMinmax;
    look.settings.culling.tilePixels = 64;
    look.settings.samples = 4;
    Preferences preferences;
    remember(preferences, state, {});
    EXPECT_EQ(preferences.technique, "forward_plus");
    EXPECT_EQ(preferences.toneMap, "aces");
    EXPECT_EQ(preferences.layout, frame::layoutTable().back().name);
    EXPECT_EQ(preferences.culling, "tile_minmax");
    EXPECT_EQ(preferences.tile, 64);
    EXPECT_EQ(preferences.samples, 4);
}

TEST(Remember, whatWasRememberedAlwaysFollowsTheLatestChoice) {
    Preferences preferences;
    preferences.technique = "forward";
    State state;
    state.looks[0].technique = recipes::Technique::Deferred;
    remember(preferences, state, state.looks[0]); // the look began as what was remembered, or was changed back
    EXPECT_EQ(preferences.technique, "deferred");
}

} // namespace
} // namespace tessera::viewer
