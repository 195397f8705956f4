#include "apps/Progress.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace tessera::app {
namespace {

constexpr int kMostBar = 40;  // a longer bar adds no information
constexpr int kLeastBar = 10; // a shorter one is too coarse
constexpr int kUsualColumns = 80;

int columnsOf(std::FILE* stream) {
    winsize size{};
    const bool isKnown = ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return isKnown ? size.ws_col : kUsualColumns;
}

} // namespace

bool ProgressOutput::streamIsTerminal(std::FILE* stream) {
    return isatty(fileno(stream)) == 1;
}

std::string durationText(double seconds) {
    // Clamps to 1000 hours: longer estimates are meaningless, and lround() must not overflow.
    const long whole = std::lround(std::clamp(seconds, 0.0, 3.6e6));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

std::string progressLine(std::string_view label, std::size_t done, std::size_t total, double elapsedSeconds,
                         int columns) {
    done = std::min(done, total);
    const std::string head = fmt::format("{}  ", label);
    std::string tail = fmt::format("{}/{}", done, total);
    if (done > 0) tail += fmt::format("  {} left", durationText(elapsedSeconds * double(total - done) / double(done)));
    const int room = std::min(columns - int(head.size() + tail.size()) - 4, kMostBar); // 4: brackets and a gap
    std::string line = head;
    if (room >= kLeastBar) {
        const double share = total > 0 ? double(done) / double(total) : 0.0;
        const std::size_t filled = std::size_t(share * room);
        line += fmt::format("[{}{}]  ", std::string(filled, '#'), std::string(std::size_t(room) - filled, '-'));
    }
    line += tail;
    return line.substr(0, std::size_t(std::max(columns, 0)));
}

Progress::Progress(std::string label, std::size_t total, bool quiet, ProgressOutput output)
    : label_(std::move(label)), total_(total), output_(output) {
    if (!quiet && output_.isTerminal) thread_ = std::thread(&Progress::drawUntilStopped, this);
}

void Progress::drawUntilStopped() {
    using Clock = std::chrono::steady_clock;
    using Seconds = std::chrono::duration<double>;
    const Clock::time_point start = Clock::now();
    bool hasDrawn = false;
    std::unique_lock lock(mutex_);
    Seconds wait(output_.delaySeconds);
    while (!stopping_.wait_for(lock, wait, [this] { return isStopping_; })) {
        const int columns = output_.columns > 0 ? output_.columns : columnsOf(output_.stream);
        const double elapsedSeconds = Seconds(Clock::now() - start).count();
        // One column stays free: a full line would make some terminals wrap.
        const std::string line = progressLine(label_, done_, total_, elapsedSeconds, columns - 1);
        std::fputs(("\r" + line + "\x1b[K").c_str(), output_.stream);
        std::fflush(output_.stream);
        hasDrawn = true;
        wait = Seconds(output_.intervalSeconds);
    }
    if (hasDrawn) {
        std::fputs("\r\x1b[K", output_.stream);
        std::fflush(output_.stream);
    }
}

void Progress::finish() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        isStopping_ = true;
    }
    stopping_.notify_one();
    thread_.join();
}

} // namespace tessera::app
