#pragma once
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace tessera::app {

/// Where and when a progress bar is drawn; the defaults suit programs.
struct ProgressOutput {
    std::FILE* stream = stderr;
    bool isTerminal = streamIsTerminal(stream); ///< false: nothing is written
    int columns = 0;                            ///< width of the terminal; 0: queries it
    double delaySeconds = 2.0;                  ///< shorter work shows no bar
    double intervalSeconds = 0.2;               ///< between redraws

    static bool streamIsTerminal(std::FILE* stream);
};

/// A progress bar with the remaining time, on stderr. A separate thread redraws it, so that it also moves during long
/// steps. The destructor removes it, also after an exception.
class Progress {
public:
    Progress(std::string label, std::size_t total, bool quiet = false, ProgressOutput output = {});
    ~Progress() { finish(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Counts finished steps; from any thread.
    void advance(std::size_t steps = 1) { done_ += steps; }
    /// Removes the bar, so that later output on stderr starts on a clean line.
    void finish();

private:
    void drawUntilStopped();

    std::string label_;
    std::size_t total_;
    ProgressOutput output_;
    std::atomic<std::size_t> done_ = 0;
    std::mutex mutex_;
    std::condition_variable stopping_;
    bool isStopping_ = false; ///< under mutex_
    std::thread thread_;
};

/// The bar as one line of at most `columns` characters, such as "rendering  [####------]  4/10  6 s left".
std::string progressLine(std::string_view label, std::size_t done, std::size_t total, double elapsedSeconds,
                         int columns);

/// Human-readable duration: "8 s", "3 min 20 s", "2 h 5 min".
std::string durationText(double seconds);

} // namespace tessera::app
