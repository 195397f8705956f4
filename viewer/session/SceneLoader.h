#pragma once
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "scenes/Load.h"
#include "scenes/write/SceneOrigin.h"

namespace tessera::viewer {

/// Loads scenes in the background, one at a time; a new request gives the one under way up.
class SceneLoader {
public:
    struct Result {
        std::string source;
        scenes::LoadOptions load;
        std::optional<scenes::SceneOrigin> origin; ///< of the scene, for saving it with edits
        std::optional<scenes::Scene> scene;        ///< none: `error` says why
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
    /// The result of the latest start(), once.
    std::optional<Result> take();
    bool hasResult() const;
    /// What is being loaded; empty: nothing.
    const std::string& loading() const { return loading_; }

private:
    std::function<void()> done_;
    std::string loading_;
    mutable std::mutex mutex_;
    std::optional<Result> result_;
    std::vector<std::jthread> threads_; ///< the last may be loading; a thread is as small as its stack
};

} // namespace tessera::viewer
