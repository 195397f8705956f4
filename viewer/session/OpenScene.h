#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scenes/write/SceneOrigin.h"
#include "viewer/session/History.h"
#include "viewer/session/SeenEnvironment.h"
#include "viewer/session/ShownCamera.h"

namespace tessera::viewer {

/// An open scene with its edits, all of which can be undone. Its address is fixed, because a renderer draws it.
class OpenScene {
public:
    /// `filtered`, of the scene's environment, may be null: then it is filtered when a frame needs it. `seen` is the
    /// initial rotation and intensity that looks apply to the environment.
    OpenScene(std::string source, const scenes::LoadOptions& load, scenes::Scene loaded, scenes::SceneOrigin origin,
              std::shared_ptr<const frame::FilteredEnvironment> filtered = {},
              const scenes::EnvironmentView& seen = {});
    OpenScene(const OpenScene&) = delete;
    OpenScene& operator=(const OpenScene&) = delete;

    const std::string& source() const { return source_; } ///< as passed to loadScene()
    const scenes::SceneOrigin& origin() const { return origin_; }
    /// Whether the scene differs from its loaded or last saved state, by edits or undos.
    bool isEdited() const { return !history_.isSaved(); }
    /// Counts edits, including undone and redone ones.
    std::uint64_t edits() const { return edits_; }
    /// Counts those that change the image.
    std::uint64_t pictureEdits() const { return pictureEdits_; }
    /// Continues as the scene of a file that was just saved with all edits and the current camera. The image stays the
    /// same. Rotation and intensity of environmentView() become the environment's own, also in environments that undo
    /// restores, and environmentView() is reset. Without an environment it stays.
    void becomes(const std::string& file);
    /// Exchanges the scene's options and returns the previous ones. This is not an edit.
    scenes::SceneOptions exchangeOptions(scenes::SceneOptions options) {
        return std::exchange(scene_.options, std::move(options));
    }
    const scenes::LoadOptions& load() const { return load_; }
    const scenes::Scene& scene() const { return scene_; }

    // ---- Edits: each is a step of the history ----
    const History& history() const { return history_; }
    /// Changes the values of a light, a material or a hook parameter. No effect if they are equal.
    void changeLight(std::size_t index, scenes::Light changed, Gesture gesture = Gesture::Once);
    /// The same for several lights by index, in one step; at least one.
    void changeLights(const std::map<std::size_t, scenes::Light>& changed, Gesture gesture = Gesture::Once);
    void changeMaterial(std::size_t index, scenes::Material changed, Gesture gesture = Gesture::Once);
    void changeHookParameter(std::size_t parameter, float value, Gesture gesture = Gesture::Once);
    /// Replaces `count` lights from `first` on. `what` describes the step to the user: "delete light 'lamp 3'".
    void replaceLights(std::string what, std::size_t first, std::size_t count, Lights others);
    /// Deletes lights by ascending indices; at least one. `what` is as above.
    void deleteLights(std::string what, std::span<const std::size_t> indices);
    /// Replaces the scene's environment by another one, with the rotation of the scene's own (scenes::layAs()).
    void takeEnvironment(ChosenEnvironment chosen);
    /// Sets the rotation and intensity applied to the environment's own. No effect without an environment.
    void changeEnvironmentView(const scenes::EnvironmentView& changed, Gesture gesture = Gesture::Once);
    /// The rotation and intensity that looks apply.
    const scenes::EnvironmentView& environmentView() const { return environment_.view(); }
    /// Ends the drag that edits with Gesture::GoesOn.
    void endGesture() { history_.endGesture(); }
    /// Undoes or redoes a step. Returns the edit after the exchange; null if there is none.
    const Edit* undo();
    const Edit* redo();
    /// Whether goOnFrom() may be called on the same scene loaded with other materials: the saved state is reachable by
    /// steps, and has the same lights, cameras and animated numbers, and the same values of each edited material.
    /// Throws what undo() throws.
    bool canGoOnAs(const scenes::Scene& loaded);
    /// Takes over the history, and thus the edits, of an open scene that was loaded from the same file. The camera
    /// stays where it is here. The other scene is left in its saved state, without a history.
    void goOnFrom(OpenScene& other);
    /// Its edits count as unsaved from now on, whatever is undone: it was opened from a recovery file.
    void markUnsaved() { history_.markUnsaved(); }

    /// Poses the scene at a time of the playing clip, except edited values of lights, and the displayed camera unless
    /// it follows the clip. Returns whether anything may have moved. Throws InputError if something then lies too far
    /// away; the previous pose stays, and the next time is tried again.
    bool showTime(double timeSeconds);
    /// Time of the last key of the playing clips, which stand still from then on; 0 if none plays.
    double clipSeconds() const { return clipSeconds_; }
    /// Plays another clip from its beginning, named as for --clip. Throws InputError if it does not exist, or moves
    /// something too far away; the previous clip then stays.
    void playClip(const std::string& nameOrNumber);
    /// Moves to the clip's camera and follows it, or stays here. The move is a step of the history.
    void followClipCamera(bool follows);
    /// Counts changes of the geometry by clips.
    std::uint64_t geometryRevision() const { return geometryRevision_; }
    std::uint64_t environmentRevision() const { return environment_.revision(); }
    /// The filtered environment, if it is known; may be null.
    const std::shared_ptr<const frame::FilteredEnvironment>& filteredEnvironment() const {
        return environment_.filtered();
    }
    /// Counts changes of the image: edits, and movements of the camera.
    std::uint64_t revision() const { return revision_ + shown_.revision(); }
    std::uint64_t materialRevision() const { return materialRevision_; }

    const scenes::Box3& boundsWS() const { return boundsWS_; } ///< over the playing clips

    // ---- The displayed camera, see ShownCamera ----
    const std::vector<scenes::Camera>& cameras() const { return shown_.cameras(); }
    const std::vector<scenes::Camera>& loadedCameras() const { return shown_.loadedCameras(); }
    int camera() const { return shown_.index(); }
    CameraRig& rig() { return shown_.rig(); }
    const CameraRig& rig() const { return shown_.rig(); }
    const scenes::CameraChange& placed() const { return shown_.placed(); }
    bool clipMovesCamera() const { return shown_.isOfClip(); }
    bool followsClipCamera() const { return shown_.followsClip(); }
    scenes::CameraChange cameraChange() const { return shown_.change(); }
    /// Switches to another of the scene's cameras. For a built-in scene, its vertical field of view is widened if the
    /// image that load() names is narrower than 16:9.
    void useCamera(int camera);
    void place(const scenes::CameraChange& change) { shown_.place(change); }
    void applyRig() { shown_.applyRig(); }
    // Jumps of the camera are steps of the history too, unless the camera is already there.
    void jumpToCamera(int camera);
    void jumpHome();
    /// Brings the whole scene into view, in an image of an aspect: width over height.
    void jumpToAll(double aspect);
    /// The same for a box; `what` describes the step to the user.
    void jumpTo(std::string what, const scenes::Box3& boundsWS, double aspect);
    /// Looks along a heading, as CameraRig::look().
    void jumpToHeading(std::string what, const Heading& heading, double aspect);
    /// Jumps to a pose that the user edits as numbers, or changes the field of view of a perspective camera.
    void moveCamera(const CameraPose& pose, Gesture gesture);
    void changeFieldOfView(double degrees, Gesture gesture);
    /// Pans so that orbits turn about a point.
    void turnAbout(const glm::dvec3& pivotWS);

    // ---- Viewpoints: cameras that the user stored, saved after the scene's own ----
    const std::vector<scenes::Camera>& viewpoints() const { return viewpoints_; }
    /// These are edits of the scene. New viewpoints are named "view 1" and so on.
    void storeViewpoint();
    void removeViewpoint(std::size_t index);
    void jumpToViewpoint(std::size_t index);

private:
    void apply(std::string what, Edit edit, Gesture gesture = Gesture::Once);
    void exchange(Edit& edit);
    /// Exchanges an edit that was made at another time of the clip.
    void exchangeLater(Edit& edit);
    void exchange(LightsEdit& edit);
    void exchange(MaterialEdit& edit);
    void exchange(HookEdit& edit);
    void exchange(EnvironmentEdit& edit) { environment_.exchange(edit.other); }
    void exchange(EnvironmentViewEdit& edit) { environment_.exchange(edit.own, edit.view); }
    void exchange(CameraEdit& edit) { shown_.exchange(edit.other); }
    void exchange(ViewpointsEdit& edit) { viewpoints_.swap(edit.others); }
    /// The views' rotation and intensity become the environments' own.
    void takeAsSeen();
    bool isLike(const scenes::Scene& loaded) const;
    bool isSeen(const Edit& edit) const;
    /// Undoes (negative) or redoes a number of steps.
    void step(std::ptrdiff_t steps);
    /// Starts a jump, and records the previous camera.
    void jump(std::string what, const std::function<void()>& begin);
    /// Records a jump that has started.
    void keepJump(std::string what, CameraView before, Gesture gesture = Gesture::Once);
    /// Poses a scene that has poses; the user's camera stays.
    void pose(double timeSeconds);

    std::string source_;
    scenes::LoadOptions load_;
    scenes::Scene scene_;
    scenes::SceneOrigin origin_;
    SeenEnvironment environment_;
    scenes::Box3 boundsWS_;
    ShownCamera shown_;
    std::vector<scenes::Camera> viewpoints_;
    std::uint64_t revision_ = 0;
    std::uint64_t edits_ = 0, pictureEdits_ = 0;
    History history_;
    double clipSeconds_;            ///< see clipSeconds()
    double requestedSeconds_ = 0.0; ///< requested time of the clip, whose pose may have been refused
    double shownSeconds_ = 0.0;     ///< displayed time of the clip
    std::uint64_t materialRevision_ = 0, geometryRevision_ = 0;
};

} // namespace tessera::viewer
