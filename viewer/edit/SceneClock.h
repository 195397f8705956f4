#pragma once

namespace tessera::viewer {

/// The time at which animated lights are shown: runs, pauses, and can be set.
class SceneClock {
public:
    bool isRunning() const { return isRunning_; }
    void run(bool on) { isRunning_ = on; }
    void set(double timeSeconds) { timeSeconds_ = timeSeconds; }
    double timeSeconds() const { return timeSeconds_; }
    /// Moves on by real time, while it runs.
    void advance(double stepSeconds) { timeSeconds_ += isRunning_ ? stepSeconds : 0.0; }

private:
    double timeSeconds_ = 0.0;
    bool isRunning_ = false;
};

} // namespace tessera::viewer
