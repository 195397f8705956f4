#include <gtest/gtest.h>

#include "tests/unit/viewer/ControlledWindow.h"

namespace tessera::viewer {
namespace {

using Kind = InputEvent::Kind;

/// A queue of these events.
InputQueue queueOf(std::initializer_list<InputEvent> events) {
    InputQueue queue;
    for (const InputEvent& event : events) queue.push(event);
    return queue;
}

InputEvent at(Kind kind, float x, int code = 0, bool down = true) {
    InputEvent event{kind, code, down};
    event.position = {x, 0.0f};
    return event;
}

TEST(InputQueue, aPressAndItsReleaseReachDifferentFrames) {
    InputQueue queue = queueOf({at(Kind::Button, 1.0f, 0, true), at(Kind::Button, 1.0f, 0, false)});
    ASSERT_EQ(queue.takeFrame().size(), 1u);
    EXPECT_FALSE(queue.empty());
    const std::vector<InputEvent> second = queue.takeFrame();
    ASSERT_EQ(second.size(), 1u);
    EXPECT_FALSE(second[0].down);
    EXPECT_TRUE(queue.empty());
}

TEST(InputQueue, thePointerNeverLeavesWhereAButtonChangedWithinTheFrame) {
    InputQueue queue = queueOf({at(Kind::Move, 1.0f), at(Kind::Button, 1.0f), at(Kind::Move, 9.0f)});
    const std::vector<InputEvent> first = queue.takeFrame();
    ASSERT_EQ(first.size(), 2u);
    EXPECT_EQ(first.back().position.x, 1.0f);
    EXPECT_EQ(queue.takeFrame().front().position.x, 9.0f);
}

TEST(InputQueue, aDragReachesItsEndAFrameBeforeTheButtonIsLetGo) {
    InputQueue queue = queueOf({at(Kind::Move, 9.0f), at(Kind::Button, 9.0f, 0, false)});
    ASSERT_EQ(queue.takeFrame().size(), 1u);
    EXPECT_EQ(queue.takeFrame().front().kind, Kind::Button);
}

TEST(InputQueue, ofAPointerOnItsWayExactlyTheEndIsKept) {
    InputQueue queue;
    for (int i = 0; i < 100; ++i) queue.push(at(Kind::Move, float(i)));
    const std::vector<InputEvent> taken = queue.takeFrame();
    ASSERT_EQ(taken.size(), 1u);
    EXPECT_EQ(taken[0].position.x, 99.0f);
}

TEST(InputQueue, aPathIsAsOldAsItsBeginning) {
    InputQueue queue;
    for (const double seconds : {1.0, 2.0, 3.0}) {
        InputEvent event = at(Kind::Move, float(seconds));
        event.heardSeconds = seconds;
        queue.push(event);
    }
    EXPECT_EQ(queue.takeFrame().front().heardSeconds, 1.0);
}

TEST(InputQueue, buttonsWheelAndKeysAreUrgentButNotAKeyThatIsHeld) {
    InputQueue queue;
    EXPECT_FALSE(queue.isUrgent());
    queue.push(at(Kind::Move, 1.0f));
    queue.push(at(Kind::Focus, 1.0f));
    InputEvent held = at(Kind::Key, 1.0f, 87);
    held.repeated = true;
    queue.push(held);
    queue.push(at(Kind::Character, 1.0f, 'w')); // comes with the key each time
    EXPECT_FALSE(queue.isUrgent()) << "a flying user would never see a slow picture";
    for (const Kind kind : {Kind::Button, Kind::Scroll, Kind::Key}) {
        InputQueue more = queue;
        more.push(at(kind, 1.0f));
        EXPECT_TRUE(more.isUrgent());
    }
}

TEST(InputQueue, differentKeysShareAFrame) {
    InputQueue queue = queueOf({at(Kind::Key, 0.0f, 65), at(Kind::Key, 0.0f, 66), at(Kind::Character, 0.0f, 'a'),
                                at(Kind::Key, 0.0f, 65, false)});
    EXPECT_EQ(queue.takeFrame().size(), 3u);
    EXPECT_EQ(queue.takeFrame().size(), 1u);
}

using test::kControlKey;
using test::kEnterKey;

TEST(InputQueue, textBehindEnterReachesTheNextFrameAndTextBeforeItTheSame) {
    InputQueue queue = queueOf({at(Kind::Key, 0.0f, 65), at(Kind::Character, 0.0f, 'a'), at(Kind::Key, 0.0f, kEnterKey),
                                at(Kind::Key, 0.0f, 66), at(Kind::Character, 0.0f, 'b')});
    EXPECT_EQ(queue.takeFrame().size(), 4u);
    EXPECT_EQ(queue.takeFrame().front().code, 'b');
}

TEST(InputQueue, aModifierChangesInAFrameOnlyBeforeEventsThatReadIt) {
    for (const InputEvent& event : {at(Kind::Key, 0.0f, kEnterKey), at(Kind::Button, 0.0f), at(Kind::Scroll, 0.0f),
                                    at(Kind::Character, 0.0f, 'a')}) {
        InputQueue queue = queueOf({at(Kind::Key, 0.0f, kControlKey), event});
        EXPECT_EQ(queue.takeFrame().size(), 2u);
        queue.push(event);
        queue.push(at(Kind::Key, 0.0f, kControlKey, false));
        EXPECT_EQ(queue.takeFrame().size(), 1u) << "Ctrl is still held";
        EXPECT_EQ(queue.takeFrame().front().code, kControlKey);
    }
    InputQueue releases = queueOf({at(Kind::Key, 0.0f, kEnterKey, false), at(Kind::Key, 0.0f, kControlKey, false)});
    EXPECT_EQ(releases.takeFrame().size(), 2u);
}

TEST(InputQueue, keysThatWaitKeepTheirOrderAndWhatCameBeforeThemDoesNot) {
    InputQueue queue = queueOf({at(Kind::Key, 1.0f, kControlKey, false), // its press did not wait
                                at(Kind::Character, 1.0f, 'a'), at(Kind::Key, 1.0f, kEnterKey), at(Kind::Move, 2.0f)});
    const std::vector<InputEvent> before = queue.takeFrame(true);
    ASSERT_EQ(before.size(), 1u);
    EXPECT_EQ(before[0].code, kControlKey);
    EXPECT_TRUE(queue.takeFrame(true).empty());
    const std::vector<InputEvent> waited = queue.takeFrame();
    ASSERT_EQ(waited.size(), 3u);
    EXPECT_EQ(waited[0].kind, Kind::Character);
    EXPECT_EQ(waited[1].code, kEnterKey);
    EXPECT_EQ(waited[2].kind, Kind::Move);
}

} // namespace
} // namespace tessera::viewer
