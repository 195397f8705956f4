#include "viewer/session/EnvironmentJob.h"

#include <cassert>
#include <exception>
#include <new>
#include <utility>

#include "renderer/frame/ComputedCache.h"
#include "scenes/Load.h"
#include "scenes/LoadLedger.h"

namespace tessera::viewer {
namespace {

/// `isOver` is polled during computation and filtering, from any thread. Once it holds, the result is useless.
ChosenEnvironment loaded(const std::string& name, EnvironmentProgress& progress, const std::function<bool()>& isOver) {
    const auto report = [&](bool isFiltering, double done) {
        if (isOver()) throw scenes::LoadStopped();
        progress.report({isFiltering, done});
    };
    ChosenEnvironment chosen;
    chosen.name = name;
    try {
        scenes::LoadLedger ledger;
        ledger.reportEnvironment([&report](double done) { report(false, done); });
        chosen.environment = scenes::environmentCalled(name, ledger, chosen.warnings);
        if (chosen.environment)
            chosen.filtered = std::make_shared<frame::FilteredEnvironment>(frame::cachedEnvironment(
                chosen.environment->map, frame::cacheFolder(), [&report](double done) { report(true, done); }));
    } catch (const std::bad_alloc&) {
        chosen.error = name + ": the memory is not enough for it; close other programs or choose a smaller picture";
    } catch (const std::exception& error) {
        chosen.error = error.what();
    }
    return chosen;
}

} // namespace

void EnvironmentJob::choose(const std::string& name) {
    ++generation_;
    choice_ = name;
    result_.reset();
}

EnvironmentJob::~EnvironmentJob() {
    discard();
}

void EnvironmentJob::start(const std::string& name) {
    assert(!name.empty());
    {
        const std::lock_guard lock(mutex_);
        choose(name);
        if (std::exchange(isBusy_, true)) return; // the running thread continues with this one
    }
    thread_ = std::jthread([this] { load(); });
}

void EnvironmentJob::discard() {
    const std::lock_guard lock(mutex_);
    choose({});
}

void EnvironmentJob::load() {
    for (;;) {
        std::string name;
        std::uint64_t generation = 0;
        {
            const std::lock_guard lock(mutex_);
            isBusy_ = !choice_.empty();
            if (!isBusy_) return;
            name = choice_;
            generation = loading_ = generation_;
            progress_.begin();
        }
        ChosenEnvironment chosen = loaded(name, progress_, [&] { return generation != generation_; });
        {
            const std::lock_guard lock(mutex_);
            if (generation != generation_) continue;
            result_ = std::move(chosen);
            isBusy_ = false;
        }
        return done_();
    }
}

std::string EnvironmentJob::choice() const {
    const std::lock_guard lock(mutex_);
    return choice_;
}

std::optional<EnvironmentShare> EnvironmentJob::share() const {
    const std::lock_guard lock(mutex_);
    return loading_ == generation_ ? progress_.latest() : std::nullopt;
}

bool EnvironmentJob::hasResult() const {
    const std::lock_guard lock(mutex_);
    return result_.has_value();
}

std::optional<ChosenEnvironment> EnvironmentJob::take() {
    const std::lock_guard lock(mutex_);
    std::optional<ChosenEnvironment> result = std::exchange(result_, std::nullopt);
    if (result) choose({});
    return result;
}

} // namespace tessera::viewer
