#include "viewer/session/FigureJob.h"

#include <cassert>
#include <utility>

namespace tessera::viewer {

void FigureJob::start(validation::Picture a, validation::Picture b) {
    assert(!busy_);
    busy_ = true;
    thread_ = std::jthread([this, a = std::move(a), b = std::move(b)] {
        const validation::ErrorFigures figures = validation::errorFigures(a, b);
        {
            const std::lock_guard lock(mutex_);
            result_ = figures;
        }
        busy_ = false;
        done_();
    });
}

bool FigureJob::hasResult() const {
    const std::lock_guard lock(mutex_);
    return result_.has_value();
}

std::optional<validation::ErrorFigures> FigureJob::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

} // namespace tessera::viewer
