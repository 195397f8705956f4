#include "viewer/session/EnvironmentJob.h"

#include <cassert>
#include <exception>
#include <new>
#include <utility>

#include "renderer/frame/EnvironmentCache.h"
#include "scenes/Load.h"
#include "scenes/LoadLedger.h"

namespace tessera::viewer {
namespace {

ChosenEnvironment loaded(const std::string& name) {
    ChosenEnvironment chosen;
    chosen.name = name;
    try {
        scenes::LoadLedger ledger;
        chosen.environment = scenes::environmentCalled(name, ledger, chosen.warnings);
        if (chosen.environment)
            chosen.filtered = std::make_shared<frame::FilteredEnvironment>(
                frame::cachedEnvironment(chosen.environment->map, frame::cacheFolder()));
    } catch (const std::bad_alloc&) {
        chosen.error = name + ": the memory is not enough for it; close other programs or choose a smaller picture";
    } catch (const std::exception& error) {
        chosen.error = error.what();
    }
    return chosen;
}

} // namespace

bool EnvironmentJob::isBusy() const {
    const std::lock_guard lock(mutex_);
    return isBusy_;
}

void EnvironmentJob::start(const std::string& name) {
    assert(!isBusy());
    {
        const std::lock_guard lock(mutex_);
        isBusy_ = true;
    }
    thread_ = std::jthread([this, name] {
        ChosenEnvironment chosen = loaded(name);
        {
            const std::lock_guard lock(mutex_);
            result_ = std::move(chosen);
            isBusy_ = false;
        }
        done_();
    });
}

bool EnvironmentJob::hasResult() const {
    const std::lock_guard lock(mutex_);
    return result_.has_value();
}

std::optional<ChosenEnvironment> EnvironmentJob::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

} // namespace tessera::viewer
