#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "renderer/frame/EnvironmentFilter.h"
#include "scenes/Load.h"
#include "scenes/write/SceneOrigin.h"
#include "viewer/session/EnvironmentShare.h"

namespace tessera::viewer {

/// Loads scenes in the background, one at a time: two large ones at once might be more than the memory holds. A new
/// request gives the one under way up, and takes the place of one that waits.
class SceneLoader {
public:
    struct Result {
        std::string source;
        scenes::LoadOptions load;
        std::optional<scenes::SceneOrigin> origin;                  ///< of the scene, for saving it with edits
        std::optional<scenes::Scene> scene;                         ///< none: `error` says why
        std::shared_ptr<const frame::FilteredEnvironment> filtered; ///< where it has an environment
        std::string error;
        double seconds = 0.0;
    };

    /// `done` is called on the loading thread when a result waits.
    explicit SceneLoader(std::function<void()> done) : done_(std::move(done)) {}
    /// Gives a load under way up and waits for it to end.
    ~SceneLoader();
    SceneLoader(const SceneLoader&) = delete;
    SceneLoader& operator=(const SceneLoader&) = delete;

    void start(const std::string& source, const scenes::LoadOptions& options);
    /// How far the environment of the scene under way is; none where something else is done.
    std::optional<EnvironmentShare> environmentShare() const;
    /// The result of the latest start(), once.
    std::optional<Result> take();
    bool hasResult() const;
    /// The scene that it is; null where there is none. Until take() or start().
    const scenes::Scene* scene() const;

private:
    struct Request {
        std::string source;
        scenes::LoadOptions options; ///< `stop` is the load's own
    };
    void work();

    std::function<void()> done_;
    EnvironmentProgress progress_;
    mutable std::mutex mutex_; ///< of all below but the thread
    std::optional<Request> waiting_;
    std::stop_source stop_; ///< of the load under way
    bool isWorking_ = false;
    std::optional<Result> result_;
    std::jthread thread_; ///< last: it ends before what it uses
};

} // namespace tessera::viewer
