#include "viewer/session/EventLog.h"

#include <gtest/gtest.h>

namespace tessera::viewer {
namespace {

TEST(EventLog, anEventIsOneLineThatNoTerminalObeys) {
    testing::internal::CaptureStdout();
    EventLog(true).line("error a\x1b[2J.obj: broken\nsee there");
    EventLog(false).line("nothing");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "error a\\x1b[2J.obj: broken; see there\n");
}

} // namespace
} // namespace tessera::viewer
