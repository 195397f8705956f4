#include "apps/Progress.h"

#include <chrono>
#include <memory>

#include <gmock/gmock.h>

namespace tessera::app {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string contents(std::FILE* file) {
    std::string text(std::size_t(std::ftell(file)), '\0');
    std::rewind(file);
    text.resize(std::fread(text.data(), 1, text.size(), file));
    return text;
}

/// Output settings that draw at once; `stream` stands in for the terminal.
ProgressOutput eager(std::FILE* stream, bool isTerminal) {
    return {stream, isTerminal, 80, 0.0, 0.001};
}

void waitForOutput(std::FILE* file) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (std::ftell(file) == 0 && std::chrono::steady_clock::now() < deadline)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(Progress, theLineShowsTheShareTheCountAndTheTimeLeft) {
    EXPECT_EQ(progressLine("rendering", 4, 10, 4.0, 45), "rendering  [######----------]  4/10  6 s left");
    EXPECT_EQ(progressLine("rendering", 0, 10, 4.0, 29), "rendering  [----------]  0/10"); // the rate is unknown
    EXPECT_EQ(progressLine("x", 10, 10, 4.0, 35), "x  [#############]  10/10  0 s left");
    EXPECT_EQ(progressLine("x", 0, 0, 4.0, 20), "x  [----------]  0/0");
}

TEST(Progress, theLineIsNotLongerThanTheTerminalIsWide) {
    for (int columns = 0; columns < 120; ++columns)
        EXPECT_LE(progressLine("a rather long label", 12, 345, 6.0, columns).size(), std::size_t(columns));
}

TEST(Progress, moreStepsThanPlannedNeverExceedTheTotal) {
    EXPECT_THAT(progressLine("x", 12, 10, 4.0, 60), HasSubstr("10/10  0 s left"));
}

TEST(Progress, aDurationHasAtMostTwoUnits) {
    EXPECT_EQ(durationText(0.2), "0 s");
    EXPECT_EQ(durationText(59.4), "59 s");
    EXPECT_EQ(durationText(59.6), "1 min 0 s");
    EXPECT_EQ(durationText(200.0), "3 min 20 s");
    EXPECT_EQ(durationText(7500.0), "2 h 5 min");
    EXPECT_EQ(durationText(1e300), "1000 h 0 min");
}

TEST(Progress, theBarRemovesItselfAtTheEnd) {
    const File file(std::tmpfile());
    {
        Progress progress("comparing", 3, false, eager(file.get(), true));
        progress.advance(2);
        waitForOutput(file.get());
    }
    const std::string text = contents(file.get());
    EXPECT_THAT(text, HasSubstr("\rcomparing  ["));
    EXPECT_THAT(text, HasSubstr("/3"));
    EXPECT_THAT(text, EndsWith("\r\x1b[K"));
}

TEST(Progress, nothingIsWrittenWithoutATerminalOrWhenQuietOrBeforeTheDelay) {
    const File file(std::tmpfile());
    ProgressOutput late = eager(file.get(), true);
    late.delaySeconds = 60.0;
    {
        Progress noTerminal("x", 1, false, eager(file.get(), false));
        Progress quiet("x", 1, true, eager(file.get(), true));
        Progress brief("x", 1, false, late);
        brief.advance();
        std::this_thread::sleep_for(std::chrono::milliseconds(30)); // many update intervals of the eager bars
    }
    EXPECT_THAT(contents(file.get()), IsEmpty());
}

} // namespace
} // namespace tessera::app
