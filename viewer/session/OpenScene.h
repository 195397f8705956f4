#pragma once
#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scenes/Clips.h"
#include "scenes/Defaults.h"
#include "scenes/write/SceneOrigin.h"
#include "viewer/session/CameraRig.h"
#include "viewer/session/EnvironmentJob.h"
#include "viewer/session/History.h"

namespace tessera::viewer {

/// An open scene, as loaded and with later edits, which can all be undone. Its address is fixed, since a renderer draws
/// it.
class OpenScene {
public:
    /// `filtered`, of the scene's environment, may be null: it is filtered when a frame needs it. `seen` is how looks
    /// turn and brighten that to begin with.
    OpenScene(std::string source, const scenes::LoadOptions& load, scenes::Scene loaded, scenes::SceneOrigin origin,
              std::shared_ptr<const frame::FilteredEnvironment> filtered = {},
              const scenes::EnvironmentView& seen = {});
    OpenScene(const OpenScene&) = delete;
    OpenScene& operator=(const OpenScene&) = delete;

    const std::string& source() const { return source_; } ///< as loadScene() takes it
    const scenes::SceneOrigin& origin() const { return origin_; }
    /// The scene differs from what was loaded or saved last by edits that were made, or undone, since.
    bool isEdited() const { return !history_.isSaved(); }
    /// Counts edits, undone and redone ones too.
    std::uint64_t edits() const { return edits_; }
    /// Continues as the scene of a file that was just saved with all edits and the current camera. The picture stays.
    /// What environmentView() makes of the environment is the file's own, and of those that undoing brings back; it
    /// then changes nothing of them. Without an environment it stays.
    void becomes(const std::string& file);
    /// Gives the scene other options, and returns those that it had. It is no edit.
    scenes::SceneOptions exchangeOptions(scenes::SceneOptions options) {
        return std::exchange(scene_.options, std::move(options));
    }
    const scenes::LoadOptions& load() const { return load_; }
    const scenes::Scene& scene() const { return scene_; }

    // ---- Edits: all of them are steps of the history ----
    const History& history() const { return history_; }
    /// Gives a light, a material or a parameter of the hook other values. Nothing happens where they are the same.
    void changeLight(std::size_t index, scenes::Light changed, Gesture gesture = Gesture::Once);
    void changeMaterial(std::size_t index, scenes::Material changed, Gesture gesture = Gesture::Once);
    void changeHookParameter(std::size_t parameter, float value, Gesture gesture = Gesture::Once);
    /// Puts lights in the place of `count` from `first` on. `what` tells the user: "delete light 'lamp 3'".
    void replaceLights(std::string what, std::size_t first, std::size_t count, Lights others);
    /// Deletes lights, indices from the least on; at least one. `what` is as above.
    void deleteLights(std::string what, std::span<const std::size_t> indices);
    /// Takes another environment in the place of the scene's own, which lies as that (scenes::layAs()).
    void takeEnvironment(ChosenEnvironment chosen);
    /// Turns and brightens the environment, besides its own numbers. Nothing happens where there is none.
    void changeEnvironmentView(const scenes::EnvironmentView& changed, Gesture gesture = Gesture::Once);
    /// What looks show it by.
    const scenes::EnvironmentView& environmentView() const { return environmentView_; }
    /// The drag that edits with Gesture::GoesOn is over.
    void endGesture() { history_.endGesture(); }
    /// Undoes or redoes a step; null where there is none, else the edit, after the exchange.
    const Edit* undo();
    const Edit* redo();
    /// From now on its edits are not saved, whatever is undone: what it was opened from is no scene of the user's.
    void markUnsaved() { history_.markUnsaved(); }

    /// Shows the scene at a time of the clip that plays, but what was edited of its lights, and the camera that is
    /// shown unless it follows the clip. True where something may have moved. Throws InputError where something then
    /// lies too far away; the pose before then stays, and the next time is tried anew.
    bool showTime(double timeSeconds);
    /// When the last key of the clips that play is; they stand still from then on. 0 where none plays.
    double clipSeconds() const { return clipSeconds_; }
    /// Plays another clip, as --clip takes it, from its beginning. Throws InputError where that does not exist, or
    /// moves something too far away; the one before then stays.
    void playClip(const std::string& nameOrNumber);
    /// Whether the clip that plays moves the camera that is shown, or would.
    bool clipMovesCamera() const { return scenes::movesCamera(scene_, camera_); }
    /// Whether that camera goes with the clip: one that was moved by hand, or placed, stays the user's.
    bool followsClipCamera() const { return isLed() && clipMovesCamera(); }
    /// Goes to the clip's camera and along with it, or stays here.
    void followClipCamera(bool follows);
    /// Counts changes of what clips move.
    std::uint64_t geometryRevision() const { return geometryRevision_; }
    std::uint64_t environmentRevision() const { return environmentRevision_; }
    /// Of its environment, which a renderer need not filter; may be null.
    const std::shared_ptr<const frame::FilteredEnvironment>& filteredEnvironment() const { return filtered_; }
    /// Counts changes of the picture: edits, and movements of the camera.
    std::uint64_t revision() const { return revision_; }
    std::uint64_t materialRevision() const { return materialRevision_; }

    const scenes::Box3& boundsWS() const { return boundsWS_; } ///< over the clips that play
    /// The cameras of the scene at the time that is shown, without later movements.
    const std::vector<scenes::Camera>& cameras() const { return cameras_; }
    /// The same as its file begins with them.
    const std::vector<scenes::Camera>& loadedCameras() const { return loadedCameras_; }
    int camera() const { return camera_; }
    CameraRig& rig() { return rig_; }
    const CameraRig& rig() const { return rig_; }
    /// Looks through another of the scene's cameras, to begin with. One of a built-in scene is placed with a taller
    /// field of view where the picture that load() names is narrower than the 16:9 that it is made for.
    void useCamera(int camera);
    // Jumps of the camera are steps of the history too, unless it is there already.
    void jumpToCamera(int camera);
    void jumpHome();
    /// All of the scene in view, in a picture of an aspect: width over height.
    void jumpToAll(double aspect);
    /// The same of a box; `what` tells the user.
    void jumpTo(std::string what, const scenes::Box3& boundsWS, double aspect);
    /// Slides there where orbits turn about a point.
    void turnAbout(const glm::dvec3& pivotWS);
    /// Begins with the change of the scene's camera: what changedCamera() makes of it, to the last bit. Orbiting turns
    /// about the target that it says. Throws InputError for values that no camera can have, and then does nothing.
    void place(const scenes::CameraChange& change);
    /// What place() put last; empty where the scene's camera is its own.
    const scenes::CameraChange& placed() const { return placed_; }
    /// What makes the camera that is shown of the scene's, as a command line says it, to the last bit. Empty where they
    /// are the same.
    scenes::CameraChange cameraChange() const;
    /// Puts the scene's camera to where the rig is. To be called after the rig moved.
    void applyRig();

private:
    const scenes::Camera& sceneCamera() const { return cameras_[std::size_t(camera_)]; }
    /// Orbits turn about what the camera shows in the middle of its picture; where that is nothing, about the middle of
    /// the scene.
    CameraPose poseThrough(const scenes::Camera& camera) const;
    void apply(std::string what, Edit edit, Gesture gesture = Gesture::Once);
    void exchange(Edit& edit);
    /// The same of an edit that was made at another time of the clip.
    void exchangeLater(Edit& edit);
    void exchange(LightsEdit& edit);
    void exchange(MaterialEdit& edit);
    void exchange(HookEdit& edit);
    void exchange(EnvironmentEdit& edit);
    void exchange(EnvironmentViewEdit& edit);
    void exchange(CameraEdit& edit);
    CameraView view() const { return {camera_, placed_, rig_}; }
    /// Makes what the views make of environments their own.
    void takeAsSeen();
    /// Keeps where the camera was before a jump that has begun.
    void keepJump(std::string what, CameraView before);
    /// Whether the camera that is shown goes where the scene has it.
    bool isLed() const;
    /// Poses a scene that has poses, and leaves the user's camera to the user.
    void pose(double timeSeconds);
    /// Puts the camera that is shown to where the clip has it, or else back to where the rig is.
    void placeShownCamera();
    /// Begins anew with a camera and its pose.
    void begin(const scenes::Camera& start, const CameraPose& home);

    std::string source_;
    scenes::LoadOptions load_;
    scenes::Scene scene_;
    scenes::SceneOrigin origin_;
    scenes::OwnEnvironment ownEnvironment_; ///< as the file has it
    scenes::EnvironmentView environmentView_;
    scenes::Box3 boundsWS_;
    std::vector<scenes::Camera> cameras_, loadedCameras_;
    bool mayFollow_ = true; ///< the clip's camera
    int camera_ = 0;
    scenes::CameraChange placed_; ///< made the camera that the rig started as
    CameraRig rig_;
    std::uint64_t revision_ = 0;
    std::uint64_t edits_ = 0;
    History history_;
    double clipSeconds_;        ///< as clipSeconds() says
    double askedSeconds_ = 0.0; ///< of the clip, of which the pose may have been refused
    double shownSeconds_ = 0.0; ///< of the clip
    std::uint64_t materialRevision_ = 0, environmentRevision_ = 0, geometryRevision_ = 0;
    std::shared_ptr<const frame::FilteredEnvironment> filtered_;
    std::vector<std::string> environmentWarnings_; ///< of the latest that was taken
};

} // namespace tessera::viewer
