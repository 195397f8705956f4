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

    void open(const std::string& source, const scenes::LoadOptions& load);
    bool hasResult() const { return loader_.hasResult(); }
    /// The scene that was loaded, once; null where there is none, or where it could not be and the state says why. The
    /// looks of the state become its; it still has to be put there.
    std::unique_ptr<OpenScene> take();
    /// The file that is open comes first among the recent ones.
    void noteRecent(const std::string& source);
    /// Writes what is remembered. What goes wrong is said in the state.
    void remember(glm::ivec2 windowSize);

private:
    void fail(const std::string& text);

    const ViewerOptions& options_;
    State& state_;
    const EventLog& log_;
    Look base_; ///< what the open scene began with
    bool hadScene_ = false;
    std::map<std::string, CameraPose> poses_; ///< by source, where the camera was when the scene was left
    SceneLoader loader_;
};

} // namespace tessera::viewer
