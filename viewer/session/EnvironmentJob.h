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

/// An environment that was chosen, ready to light a scene.
struct ChosenEnvironment {
    std::string name;                               ///< as --environment takes it
    std::optional<scenes::Environment> environment; ///< none: the scene has none from now on
    std::shared_ptr<const frame::FilteredEnvironment> filtered;
    std::vector<std::string> warnings;
    std::string error; ///< not empty: it could not be loaded, and the scene keeps its own
};

/// Loads and filters environments in the background, one at a time; of several choices the latest counts.
class EnvironmentJob {
public:
    /// `done` is called on the loading thread when a result waits.
    explicit EnvironmentJob(std::function<void()> done) : done_(std::move(done)) {}
    EnvironmentJob(const EnvironmentJob&) = delete;
    EnvironmentJob& operator=(const EnvironmentJob&) = delete;

    /// Gives what is computed or filtered up. A file that is being read is waited for.
    ~EnvironmentJob();

    /// Chooses an environment in the place of what was chosen before, which is given up as above.
    void start(const std::string& name);
    /// Drops what was chosen, likewise.
    void discard();
    /// What was chosen and not taken yet; empty: nothing.
    std::string choice() const;
    /// How far it is; none where it is being read, or kept from an earlier time.
    std::optional<EnvironmentShare> share() const;
    bool hasResult() const;
    /// The result of the latest choice, once.
    std::optional<ChosenEnvironment> take();

private:
    void choose(const std::string& name); ///< the caller holds the mutex
    void load();

    std::function<void()> done_;
    mutable std::mutex mutex_;
    EnvironmentProgress progress_;
    bool isBusy_ = false;
    std::atomic<std::uint64_t> generation_ = 0; ///< of the choice; changed by who holds the mutex
    std::uint64_t loading_ = 0;                 ///< the one under way, of which `progress_` tells
    std::string choice_;
    std::optional<ChosenEnvironment> result_;
    std::jthread thread_; ///< last: it ends before what it writes to
};

} // namespace tessera::viewer
