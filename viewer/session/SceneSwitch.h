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

/// Replaces the open scene by another. The user's choices stay, and the preferences are kept up to date.
class SceneSwitch {
public:
    /// `done` is called on another thread when a scene has been loaded.
    SceneSwitch(const ViewerOptions& options, State& state, const EventLog& log, std::function<void()> done);

    /// `load` applies to this load alone. Options about the first scene apply to the first call only, even if it fails;
    /// all others to every call.
    void open(const std::string& source, const scenes::LoadOptions& load = {});
    bool hasResult() const { return loader_.hasResult(); }
    /// See SceneLoader.
    std::optional<EnvironmentShare> environmentShare() const { return loader_.environmentShare(); }
    /// The loaded scene; null if loading failed. Valid until the next call of open(), take() or discard().
    const scenes::Scene* scene() const { return loader_.scene(); }
    /// Returns the loaded scene, once; null without one. It is passed to `show`, then the state's looks change to it;
    /// the caller stores it in the state. Throws if loading failed, and what `show` throws; then nothing has changed
    /// except that the result is gone.
    std::unique_ptr<OpenScene> take(const std::function<void(const OpenScene& scene)>& show);
    /// Discards the result.
    void discard();
    /// Writes the preferences if they differ from those written last. Failures become warnings.
    void remember(glm::ivec2 windowSize);

private:
    /// The view of a scene when it was left.
    struct Left {
        int index = 0;
        scenes::Camera camera; ///< of that index, as loaded
        scenes::CameraChange placed;
        std::optional<CameraPose> pose; ///< none: unmoved
        std::optional<double> aspect;   ///< for which a camera was supplied or placed
    };
    void leave(const OpenScene& scene);
    /// Restores the view of a scene as it was left, if it still has that camera.
    void comeBack(OpenScene& scene);

    const ViewerOptions& options_;
    State& state_;
    const EventLog& log_;
    Preferences preferences_; ///< of earlier runs, with choices made before the open scene was loaded
    std::optional<Preferences> written_;
    std::string fault_;                ///< why writing failed last
    Look base_;                        ///< initial look of the open scene
    bool hadScene_ = false;            ///< the state's looks and `base_` belong to a scene
    bool wasOpened_ = false;           ///< open() was called
    bool isFirstLoad_ = false;         ///< the latest load is that of program start
    std::map<std::string, Left> left_; ///< by identityOf()
    SceneLoader loader_;
};

} // namespace tessera::viewer
