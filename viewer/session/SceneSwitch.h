#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "viewer/session/EventLog.h"
#include "viewer/session/SceneLoader.h"
#include "viewer/session/State.h"
#include "viewer/session/ViewerOptions.h"

namespace tessera::viewer {

/// Replaces the open scene by another: the user's choices stay, and the preferences are kept up to date.
class SceneSwitch {
public:
    /// `done` is called on another thread when a scene waits.
    SceneSwitch(const ViewerOptions& options, State& state, const EventLog& log, std::function<void()> done);

    /// `load` applies to this load alone. Options about the first scene apply to the first call only, even if it fails;
    /// all others to every call.
    void open(const std::string& source, const scenes::LoadOptions& load = {});
    bool hasResult() const { return loader_.hasResult(); }
    /// Of SceneLoader.
    std::optional<EnvironmentShare> environmentShare() const { return loader_.environmentShare(); }
    /// What the load gave; null where it failed. Until the next call of open(), take() or discard().
    const scenes::Scene* scene() const { return loader_.scene(); }
    /// The scene that was loaded, once; null where there is none. `show` gets it first; then the looks of the state
    /// become its, and it still has to be put there. Throws where it could not be loaded, and what `show` throws; then
    /// nothing has changed but that no scene waits.
    std::unique_ptr<OpenScene> take(const std::function<void(const OpenScene& scene)>& show);
    /// Discards the result.
    void discard();
    /// Writes the preferences where they differ from those that were written last. Failures are warnings.
    void remember(glm::ivec2 windowSize);

private:
    /// How a scene was looked at when it was left.
    struct Left {
        int index = 0;
        scenes::Camera camera; ///< of that index, as the scene has it
        scenes::CameraChange placed;
        std::optional<CameraPose> pose; ///< none: nothing had moved it
        std::optional<double> aspect;   ///< for which a camera was supplied, or placed
    };
    void leave(const OpenScene& scene);
    /// Looks at a scene as it was left, where it has that camera still.
    void comeBack(OpenScene& scene);

    const ViewerOptions& options_;
    State& state_;
    const EventLog& log_;
    Preferences preferences_; ///< of earlier runs, with later choices until the open scene came
    std::optional<Preferences> written_;
    std::string fault_;                ///< why they could not be written last
    Look base_;                        ///< initial look of the open scene
    bool hadScene_ = false;            ///< the looks of the state and `base_` are a scene's
    bool wasAsked_ = false;            ///< to open a scene
    bool isFirstLoad_ = false;         ///< the latest load is that of the program's start
    std::map<std::string, Left> left_; ///< by identityOf()
    SceneLoader loader_;
};

} // namespace tessera::viewer
