#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "renderer/frame/EnvironmentFilter.h"
#include "scenes/Scene.h"

namespace tessera::viewer {

/// An environment that was chosen, ready to light a scene.
struct ChosenEnvironment {
    std::string name;                               ///< as --environment takes it
    std::optional<scenes::Environment> environment; ///< none: the scene has none from now on
    std::shared_ptr<const frame::FilteredEnvironment> filtered;
    std::vector<std::string> warnings;
    std::string error; ///< not empty: it could not be loaded, and the scene keeps its own
};

/// Loads and filters an environment in the background, one at a time.
class EnvironmentJob {
public:
    /// `done` is called on the loading thread when a result waits.
    explicit EnvironmentJob(std::function<void()> done) : done_(std::move(done)) {}
    EnvironmentJob(const EnvironmentJob&) = delete;
    EnvironmentJob& operator=(const EnvironmentJob&) = delete;

    /// Whether one is being loaded. It cannot be given up: another can only be started after its end.
    bool isBusy() const;
    void start(const std::string& name);
    bool hasResult() const;
    /// The result, once.
    std::optional<ChosenEnvironment> take();

private:
    std::function<void()> done_;
    mutable std::mutex mutex_;
    bool isBusy_ = false;
    std::optional<ChosenEnvironment> result_;
    std::jthread thread_; ///< last: it ends before what it writes to
};

} // namespace tessera::viewer
