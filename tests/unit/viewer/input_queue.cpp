#include <gtest/gtest.h>

#include "viewer/window/Input.h"

namespace tessera::viewer {
namespace {

using Kind = InputEvent::Kind;

InputEvent at(Kind kind, float x, int code = 0, bool down = true) {
    InputEvent event{kind, code, down};
    event.position = {x, 0.0f};
    return event;
}

TEST(InputQueue, aPressAndItsReleaseReachDifferentFrames) {
    InputQueue queue;
    queue.push(at(Kind::Button, 1.0f, 0, true));
    queue.push(at(Kind::Button, 1.0f, 0, false));
    ASSERT_EQ(queue.takeFrame().size(), 1u);
    EXPECT_FALSE(queue.empty());
    const std::vector<InputEvent> second = queue.takeFrame();
    ASSERT_EQ(second.size(), 1u);
    EXPECT_FALSE(second[0].down);
    EXPECT_TRUE(queue.empty());
}

TEST(InputQueue, thePointerNeverLeavesWhereAButtonChangedWithinTheFrame) {
    InputQueue queue;
    queue.push(at(Kind::Move, 1.0f));
    queue.push(at(Kind::Button, 1.0f));
    queue.push(at(Kind::Move, 9.0f));
    const std::vector<InputEvent> first = queue.takeFrame();
    ASSERT_EQ(first.size(), 2u);
    EXPECT_EQ(first.back().position.x, 1.0f);
    EXPECT_EQ(queue.takeFrame().front().position.x, 9.0f);
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
    EXPECT_FALSE(queue.isUrgent()) << "whoever flies would never see a slow picture";
    for (const Kind kind : {Kind::Button, Kind::Scroll, Kind::Key}) {
        InputQueue more = queue;
        more.push(at(kind, 1.0f));
        EXPECT_TRUE(more.isUrgent());
    }
}

TEST(InputQueue, differentKeysShareAFrame) {
    InputQueue queue;
    queue.push(at(Kind::Key, 0.0f, 65));
    queue.push(at(Kind::Key, 0.0f, 66));
    queue.push(at(Kind::Character, 0.0f, 'a'));
    queue.push(at(Kind::Key, 0.0f, 65, false));
    EXPECT_EQ(queue.takeFrame().size(), 3u);
    EXPECT_EQ(queue.takeFrame().size(), 1u);
}

} // namespace
} // namespace tessera::viewer
