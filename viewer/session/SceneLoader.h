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

/// Loads scenes in the background, one at a time: two large ones at once might exceed the memory. A new request aborts
/// the current load, and replaces a waiting request.
class SceneLoader {
public:
    struct Result {
        std::string source;
        scenes::LoadOptions load;
        std::optional<scenes::SceneOrigin> origin;                  ///< of the scene, for saving it with edits
        std::optional<scenes::Scene> scene;                         ///< none if loading failed, see `error`
        std::shared_ptr<const frame::FilteredEnvironment> filtered; ///< if it has an environment
        std::string error;
        double seconds = 0.0;
    };

    /// `done` is called on the loading thread when a result is ready.
    explicit SceneLoader(std::function<void()> done) : done_(std::move(done)) {}
    /// Aborts the current load and waits for its end.
    ~SceneLoader();
    SceneLoader(const SceneLoader&) = delete;
    SceneLoader& operator=(const SceneLoader&) = delete;

    void start(const std::string& source, const scenes::LoadOptions& options);
    /// Progress of the environment of the scene being loaded; none during other work.
    std::optional<EnvironmentShare> environmentShare() const;
    /// The result of the latest start(), once.
    std::optional<Result> take();
    bool hasResult() const;
    /// The loaded scene, until take() or start(); null without one.
    const scenes::Scene* scene() const;

private:
    struct Request {
        std::string source;
        scenes::LoadOptions options; ///< `stop` belongs to the load
    };
    void work();

    std::function<void()> done_;
    EnvironmentProgress progress_;
    mutable std::mutex mutex_; ///< guards everything below except the thread
    std::optional<Request> waiting_;
    std::stop_source stop_; ///< of the current load
    bool isWorking_ = false;
    std::optional<Result> result_;
    std::jthread thread_; ///< declared last: it ends before the members it uses
};

} // namespace tessera::viewer
