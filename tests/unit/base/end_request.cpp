#include "base/EndRequest.h"

#include <csignal>

#include <gtest/gtest.h>

namespace tessera {
namespace {

TEST(EndRequest, aSignalIsNotedOnlyWhereTheEndIsHeldAndThenEndsTheProgram) {
    EXPECT_EXIT(
        {
            bool isRight = !noteEnd(SIGINT) && notedEnd() == 0; // not held: the signal ends the program at once
            holdEnd(true);
            isRight = isRight && noteEnd(SIGTERM) && notedEnd() == SIGTERM;
            holdEnd(false);
            isRight = isRight && !noteEnd(SIGINT) && notedEnd() == SIGTERM;
            std::signal(SIGTERM, SIG_DFL);
            if (isRight) endAsNoted();
        },
        testing::KilledBySignal(SIGTERM), "");
}

} // namespace
} // namespace tessera
