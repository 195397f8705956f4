#include "viewer/session/FigureJob.h"

#include <cassert>
#include <utility>

namespace tessera::viewer {

void FigureJob::start(Picture a, Picture b) {
    assert(!busy_);
    busy_ = true;
    thread_ = std::jthread([this, a = std::move(a), b = std::move(b)] {
        std::optional<validation::ErrorFigures> figures;
        std::exception_ptr failure;
        try {
            figures = validation::errorFigures(a, b);
        } catch (...) {
            failure = std::current_exception();
        }
        {
            const std::lock_guard lock(mutex_);
            result_ = figures;
            failure_ = failure;
        }
        busy_ = false;
        done_();
    });
}

bool FigureJob::hasResult() const {
    const std::lock_guard lock(mutex_);
    return result_ || failure_;
}

std::optional<validation::ErrorFigures> FigureJob::take() {
    const std::lock_guard lock(mutex_);
    if (const std::exception_ptr failure = std::exchange(failure_, nullptr)) std::rethrow_exception(failure);
    return std::exchange(result_, std::nullopt);
}

} // namespace tessera::viewer
