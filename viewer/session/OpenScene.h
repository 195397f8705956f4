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
    /// Likewise, of those that change what is drawn.
    std::uint64_t pictureEdits() const { return pictureEdits_; }
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
    /// The same of several lights by their indices, in one step; at least one.
    void changeLights(const std::map<std::size_t, scenes::Light>& changed, Gesture gesture = Gesture::Once);
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
    const scenes::EnvironmentView& environmentView() const { return environment_.view(); }
    /// The drag that edits with Gesture::GoesOn is over.
    void endGesture() { history_.endGesture(); }
    /// Undoes or redoes a step; null where there is none, else the edit, after the exchange.
    const Edit* undo();
    const Edit* redo();
    /// Whether goOnFrom() may be called of the same scene with other materials, as it was just loaded: steps lead to
    /// what is saved of this one, and that has the same lights, cameras and animated numbers, and the same of each
    /// material that was edited. Throws what undo() throws.
    bool canGoOnAs(const scenes::Scene& loaded);
    /// Takes over the history of an open scene that was loaded from the same file, and with it what was edited. The
    /// camera stays where it is here. The other is then as it was saved, without a history.
    void goOnFrom(OpenScene& other);
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
    /// Goes to the clip's camera and along with it, or stays here. A step of the history where it went.
    void followClipCamera(bool follows);
    /// Counts changes of what clips move.
    std::uint64_t geometryRevision() const { return geometryRevision_; }
    std::uint64_t environmentRevision() const { return environment_.revision(); }
    /// Of its environment, which a renderer need not filter; may be null.
    const std::shared_ptr<const frame::FilteredEnvironment>& filteredEnvironment() const {
        return environment_.filtered();
    }
    /// Counts changes of the picture: edits, and movements of the camera.
    std::uint64_t revision() const { return revision_ + shown_.revision(); }
    std::uint64_t materialRevision() const { return materialRevision_; }

    const scenes::Box3& boundsWS() const { return boundsWS_; } ///< over the clips that play

    // ---- The camera that is shown, as ShownCamera says ----
    const std::vector<scenes::Camera>& cameras() const { return shown_.cameras(); }
    const std::vector<scenes::Camera>& loadedCameras() const { return shown_.loadedCameras(); }
    int camera() const { return shown_.index(); }
    CameraRig& rig() { return shown_.rig(); }
    const CameraRig& rig() const { return shown_.rig(); }
    const scenes::CameraChange& placed() const { return shown_.placed(); }
    bool clipMovesCamera() const { return shown_.isOfClip(); }
    bool followsClipCamera() const { return shown_.followsClip(); }
    scenes::CameraChange cameraChange() const { return shown_.change(); }
    /// Looks through another of the scene's cameras, to begin with. One of a built-in scene is placed with a taller
    /// field of view where the picture that load() names is narrower than the 16:9 that it is made for.
    void useCamera(int camera);
    void place(const scenes::CameraChange& change) { shown_.place(change); }
    void applyRig() { shown_.applyRig(); }
    // Jumps of the camera are steps of the history too, unless it is there already.
    void jumpToCamera(int camera);
    void jumpHome();
    /// All of the scene in view, in a picture of an aspect: width over height.
    void jumpToAll(double aspect);
    /// The same of a box; `what` tells the user.
    void jumpTo(std::string what, const scenes::Box3& boundsWS, double aspect);
    /// Turns about the pivot until it looks that way.
    void jumpToHeading(std::string what, const Heading& heading);
    /// Is elsewhere at once, by numbers that the user edits; the same with another field of view of a perspective
    /// camera.
    void moveCamera(const CameraPose& pose, Gesture gesture);
    void changeFieldOfView(double degrees, Gesture gesture);
    /// Slides there where orbits turn about a point.
    void turnAbout(const glm::dvec3& pivotWS);

    // ---- Viewpoints: cameras that the user stored, which a saved scene has behind its own ----
    const std::vector<scenes::Camera>& viewpoints() const { return viewpoints_; }
    /// These are edits of the scene. A new one is called "view 1" and so on.
    void storeViewpoint();
    void removeViewpoint(std::size_t index);
    void jumpToViewpoint(std::size_t index);

private:
    void apply(std::string what, Edit edit, Gesture gesture = Gesture::Once);
    void exchange(Edit& edit);
    /// The same of an edit that was made at another time of the clip.
    void exchangeLater(Edit& edit);
    void exchange(LightsEdit& edit);
    void exchange(MaterialEdit& edit);
    void exchange(HookEdit& edit);
    void exchange(EnvironmentEdit& edit) { environment_.exchange(edit.other); }
    void exchange(EnvironmentViewEdit& edit) { environment_.exchange(edit.own, edit.view); }
    void exchange(CameraEdit& edit) { shown_.exchange(edit.other); }
    void exchange(ViewpointsEdit& edit) { viewpoints_.swap(edit.others); }
    /// Makes what the views make of environments their own.
    void takeAsSeen();
    bool isLike(const scenes::Scene& loaded) const;
    bool isSeen(const Edit& edit) const;
    /// Undoes so many steps where they are negative, else redoes them.
    void step(std::ptrdiff_t steps);
    /// Jumps, and keeps where the camera was.
    void jump(std::string what, const std::function<void()>& begin);
    /// The same of a jump that has begun.
    void keepJump(std::string what, CameraView before, Gesture gesture = Gesture::Once);
    /// Poses a scene that has poses, and leaves the user's camera to the user.
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
    double clipSeconds_;        ///< as clipSeconds() says
    double askedSeconds_ = 0.0; ///< of the clip, of which the pose may have been refused
    double shownSeconds_ = 0.0; ///< of the clip
    std::uint64_t materialRevision_ = 0, geometryRevision_ = 0;
};

} // namespace tessera::viewer
