#pragma once
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "validation/figures/ErrorFigures.h"

namespace tessera::viewer {

/// Measures pairs of pictures in the background, one at a time: the figures take longer than a frame may.
class FigureJob {
public:
    /// `done` is called on the measuring thread when figures wait.
    explicit FigureJob(std::function<void()> done) : done_(std::move(done)) {}
    FigureJob(const FigureJob&) = delete;
    FigureJob& operator=(const FigureJob&) = delete;

    /// Whether a pair can be taken; a measurement cannot be given up, so the next pair waits for its end.
    bool isBusy() const { return busy_; }
    /// Picture a against the truth b, of one size.
    void start(Picture a, Picture b);
    bool hasResult() const;
    /// The latest figures, once. Rethrows an exception of the measurement, such as std::bad_alloc.
    std::optional<validation::ErrorFigures> take();

private:
    std::function<void()> done_;
    std::atomic<bool> busy_ = false;
    mutable std::mutex mutex_;
    std::optional<validation::ErrorFigures> result_;
    std::exception_ptr failure_;
    std::jthread thread_;
};

} // namespace tessera::viewer
