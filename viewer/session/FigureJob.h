#pragma once
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "validation/figures/ErrorFigures.h"

namespace tessera::viewer {

/// Measures pairs of images in the background, one at a time: the error figures take longer than a frame.
class FigureJob {
public:
    /// `done` is called on the measuring thread when figures are ready.
    explicit FigureJob(std::function<void()> done) : done_(std::move(done)) {}
    FigureJob(const FigureJob&) = delete;
    FigureJob& operator=(const FigureJob&) = delete;

    /// Whether a pair is being measured. A measurement cannot be aborted, so the next pair waits for its end.
    bool isBusy() const { return busy_; }
    /// Measures image a against the reference b, of the same size.
    void start(Picture a, Picture b);
    bool hasResult() const;
    /// Returns the latest figures, once. Rethrows an exception of the measurement, such as std::bad_alloc.
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
