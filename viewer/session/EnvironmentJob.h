#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "renderer/frame/EnvironmentFilter.h"
#include "scenes/Scene.h"
#include "viewer/session/EnvironmentShare.h"

namespace tessera::viewer {

/// A chosen environment, ready to light a scene.
struct ChosenEnvironment {
    std::string name;                               ///< as given to --environment
    std::optional<scenes::Environment> environment; ///< none: removes the scene's environment
    std::shared_ptr<const frame::FilteredEnvironment> filtered;
    std::vector<std::string> warnings;
    std::string error; ///< not empty: loading failed, and the scene keeps its environment
};

/// Loads and filters environments in the background, one at a time; the latest choice replaces earlier ones.
class EnvironmentJob {
public:
    /// `done` is called on the loading thread when a result is ready.
    explicit EnvironmentJob(std::function<void()> done) : done_(std::move(done)) {}
    EnvironmentJob(const EnvironmentJob&) = delete;
    EnvironmentJob& operator=(const EnvironmentJob&) = delete;

    /// Aborts computation and filtering. Waits for a file that is being read.
    ~EnvironmentJob();

    /// Chooses an environment. The previous choice is aborted as above.
    void start(const std::string& name);
    /// Aborts the current choice likewise.
    void discard();
    /// The choice whose result has not been taken; empty: none.
    std::string choice() const;
    /// Its progress; none while a file is read, or if the result is cached.
    std::optional<EnvironmentShare> share() const;
    bool hasResult() const;
    /// The result of the latest choice, once.
    std::optional<ChosenEnvironment> take();

private:
    void choose(const std::string& name); ///< requires the mutex
    void load();

    std::function<void()> done_;
    mutable std::mutex mutex_;
    EnvironmentProgress progress_;
    bool isBusy_ = false;
    std::atomic<std::uint64_t> generation_ = 0; ///< counts choices; changed under the mutex
    std::uint64_t loading_ = 0;                 ///< the generation being loaded, as in `progress_`
    std::string choice_;
    std::optional<ChosenEnvironment> result_;
    std::jthread thread_; ///< declared last: it ends before the members it writes to
};

} // namespace tessera::viewer
