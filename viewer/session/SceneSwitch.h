#pragma once
#include <map>
#include <memory>

#include "viewer/session/EventLog.h"
#include "viewer/session/SceneLoader.h"
#include "viewer/session/State.h"
#include "viewer/session/ViewerOptions.h"

namespace tessera::viewer {

/// Opens scenes in the place of the one that is open: what the user chose stays, and what is remembered from run to run
/// is kept up to date.
class SceneSwitch {
public:
    /// `done` is called on another thread when a scene waits.
    SceneSwitch(const ViewerOptions& options, State& state, const EventLog& log, std::function<void()> done);

    /// `load` is asked of this load alone. What the program was told of the first scene counts for the first call only,
    /// whatever becomes of it; what it was told of any scene, for all.
    void open(const std::string& source, const scenes::LoadOptions& load = {});
    bool hasResult() const { return loader_.hasResult(); }
    /// Whether that is a scene, and not a failure.
    bool hasScene() const { return loader_.hasScene(); }
    /// The scene that was loaded, once; null where there is none. `show` gets it first; then the looks of the state
    /// become its, and it still has to be put there. Throws where it could not be loaded, and what `show` throws; then
    /// nothing has changed but that no scene waits.
    std::unique_ptr<OpenScene> take(const std::function<void(const OpenScene& scene)>& show);
    /// Leaves the result aside.
    void discard();
    /// Writes what is remembered, when the window is closed. What goes wrong is told as a warning.
    void remember(glm::ivec2 windowSize);

private:
    /// How a scene was looked at when it was left.
    struct Left {
        int index = 0;
        scenes::Camera camera; ///< of that index, as the scene has it
        scenes::CameraChange placed;
        std::optional<CameraPose> pose; ///< none: nothing had moved it
    };
    void leave(const OpenScene& scene);
    /// Looks at a scene as it was left, where it has that camera still.
    void comeBack(OpenScene& scene);

    const ViewerOptions& options_;
    State& state_;
    const EventLog& log_;
    Preferences preferences_;          ///< of the runs before, and what was chosen since
    Look base_;                        ///< what the open scene began with
    bool hadScene_ = false;            ///< the looks of the state and `base_` are a scene's
    bool wasAsked_ = false;            ///< to open a scene
    bool isFirstLoad_ = false;         ///< the latest load is what the program began with
    std::map<std::string, Left> left_; ///< by identityOf()
    SceneLoader loader_;
};

} // namespace tessera::viewer
