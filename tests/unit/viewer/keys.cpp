#include <set>
#include <string>

#include <gtest/gtest.h>

#include "viewer/session/Keys.h"

namespace tessera::viewer {
namespace {

TEST(Keys, aKeyNeverStandsForTwoThings) {
    std::set<std::pair<int, int>> seen;
    for (const KeyBinding& binding : keyBindings())
        EXPECT_TRUE(seen.insert({binding.key, binding.modifiers}).second) << binding.name << " " << binding.meaning;
}

TEST(Keys, everyNamedKeyHasADescription) {
    for (const KeyBinding& binding : keyBindings()) {
        EXPECT_EQ(*binding.name == '\0', *binding.meaning == '\0') << binding.name;
        ASSERT_NE(binding.act, nullptr);
        State state;
        binding.act(state); // must work without a scene
    }
}

TEST(Keys, theHelpHasAGroupForEveryKey) {
    ASSERT_FALSE(keyBindings().empty());
    EXPECT_NE(keyBindings().front().group, nullptr);
    std::set<std::string> groups;
    for (const KeyBinding& binding : keyBindings())
        if (binding.group != nullptr) {
            EXPECT_TRUE(groups.insert(binding.group).second) << binding.group << " begins twice";
            EXPECT_NE(*binding.name, '\0') << binding.group << " would begin with a key that has no row";
        }
    EXPECT_GE(groups.size(), 5u);
}

TEST(Keys, escapeCancelsWhatTakesLongBeforeItClosesAMessage) {
    constexpr int kEscape = 256, kEnter = 257; // GLFW's
    State state;
    state.notice = {"saved", false};
    state.isCancellable = true;
    ASSERT_TRUE(pressKey(state, kEscape, 0));
    EXPECT_TRUE(state.requests.cancel);
    EXPECT_EQ(state.notice.text, "saved");
    state.requests = {};
    state.isCancellable = false;
    ASSERT_TRUE(pressKey(state, kEscape, 0));
    EXPECT_FALSE(state.requests.cancel);
    EXPECT_EQ(state.notice.text, "");
    ASSERT_TRUE(pressKey(state, kEnter, 0));
    EXPECT_TRUE(state.requests.resume);
}

TEST(Keys, digitsShowTheViewOfTheirNumber) {
    for (const frame::DebugViewInfo& info : frame::debugViewTable()) {
        if (info.key == 0) continue;
        State state;
        ASSERT_TRUE(pressKey(state, '0' + info.key, 0)); // GLFW's keys of digits are their characters
        EXPECT_EQ(state.looks[0].settings.view, info.view);
    }
}

TEST(Keys, anExposureBeyondTheSliderIsSteppedByHalfAStop) {
    State state;
    float& exposureEV = state.looks[0].settings.exposureEV;
    exposureEV = -15.0f;
    ASSERT_TRUE(pressKey(state, '[', 0));
    EXPECT_EQ(exposureEV, -15.5f);
    ASSERT_TRUE(pressKey(state, ']', 0));
    EXPECT_EQ(exposureEV, -15.0f);
    exposureEV = frame::kMostExposureEV;
    ASSERT_TRUE(pressKey(state, ']', 0));
    EXPECT_EQ(exposureEV, frame::kMostExposureEV);
}

} // namespace
} // namespace tessera::viewer
