#include "viewer/session/OpenScene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "scenes/Clips.h"
#include "scenes/Framing.h"
#include "scenes/Load.h"
#include "scenes/Pose.h"
#include "scenes/Rest.h"
#include "scenes/RigLinks.h"
#include "scenes/write/SceneText.h"
#include "viewer/edit/Pick.h"

namespace tessera::viewer {
namespace {

/// Whether a change says where a camera is or looks.
bool places(const scenes::CameraChange& change) {
    return change.eyeWS || change.targetWS || change.upWS;
}

void setOwnView(scenes::Environment& environment, const scenes::EnvironmentView& own) {
    environment.rotationDegrees = own.rotationDegrees;
    environment.intensity = own.intensity;
}

/// Cameras of built-in scenes are made for pictures of 16:9. In a narrower one a taller field of view keeps what they
/// have at the sides, up to one at whose corners things still have their shapes. It is rounded up to tenths of a degree
/// for the commands that repeat it.
scenes::CameraChange changeForAspect(const std::string& source, const scenes::Camera& camera,
                                     const std::optional<double>& aspect) {
    constexpr double kMadeForAspect = 16.0 / 9.0, kTallestDegrees = 120.0, kStepsADegree = 10.0;
    scenes::CameraChange change;
    const bool isMadeForIt =
        scenes::builtinScene(source) != nullptr && camera.projection == scenes::Projection::Perspective;
    if (!isMadeForIt || !aspect || *aspect >= kMadeForAspect) return change;
    const double halfHeight = std::tan(0.5 * camera.fovYRadians) * kMadeForAspect / *aspect;
    const double degrees = glm::degrees(2.0 * std::atan(halfHeight));
    change.fovYDegrees = std::min(std::ceil(kStepsADegree * degrees) / kStepsADegree, kTallestDegrees);
    return change;
}

} // namespace

OpenScene::OpenScene(std::string source, const scenes::LoadOptions& load, scenes::Scene loaded,
                     scenes::SceneOrigin origin, std::shared_ptr<const frame::FilteredEnvironment> filtered,
                     const scenes::EnvironmentView& seen)
    : source_(std::move(source)), load_(load), scene_(std::move(loaded)), origin_(std::move(origin)),
      ownEnvironment_(scenes::ownEnvironmentOf(scene_)), environmentView_(seen),
      boundsWS_(scenes::boundsOverClips(scene_)), cameras_(scene_.cameras), loadedCameras_(cameras_),
      rig_(cameras_.front(), poseThrough(cameras_.front()), boundsWS_),
      clipSeconds_(scenes::playingSeconds(scene_.rig)), filtered_(std::move(filtered)) {}

bool OpenScene::showTime(double timeSeconds) {
    timeSeconds = std::min(timeSeconds, clipSeconds_);
    if (!scenes::isPlaying(scene_) || timeSeconds == askedSeconds_) return false;
    askedSeconds_ = timeSeconds;
    if (timeSeconds == shownSeconds_) return false; // after one that was refused
    try {
        pose(timeSeconds);
    } catch (...) {
        pose(shownSeconds_);
        throw;
    }
    shownSeconds_ = timeSeconds;
    const scenes::MovingParts parts = scenes::movingParts(scene_);
    ++revision_;
    if (parts.geometry) ++geometryRevision_;
    if (parts.materials) ++materialRevision_;
    return true;
}

void OpenScene::playClip(const std::string& nameOrNumber) {
    const std::vector<int> before = scene_.rig.playing;
    const Lights lights = scene_.lights;
    const std::vector<scenes::Camera> cameras = cameras_;
    try {
        scene_.cameras = cameras_;
        scenes::playClip(scene_, nameOrNumber);
        cameras_ = scene_.cameras; // at rest
        pose(0.0);
    } catch (...) {
        scene_.lights = lights;
        scene_.cameras = cameras_ = cameras;
        scene_.materials = scenes::restingMaterials(scene_);
        scene_.rig.playing = before;
        pose(shownSeconds_);
        throw;
    }
    load_.clip = scene_.options.clip = nameOrNumber;
    clipSeconds_ = scenes::playingSeconds(scene_.rig);
    askedSeconds_ = shownSeconds_ = 0.0;
    ++revision_;
    ++geometryRevision_;
    ++materialRevision_;
}

bool OpenScene::isLed() const {
    return mayFollow_ && !rig_.isMoved() && rig_.isAtRest() && !places(placed_);
}

void OpenScene::followClipCamera(bool follows) {
    mayFollow_ = follows;
    if (!follows || followsClipCamera()) return;
    CameraView before = view();
    placed_ = {};
    begin(sceneCamera(), poseOf(sceneCamera(), rig_.home().focusMetres));
    keepJump("follow the clip's camera", std::move(before));
}

void OpenScene::pose(double timeSeconds) {
    scene_.cameras[std::size_t(camera_)] = sceneCamera(); // clips change the scene's own, not the user's
    scenes::poseScene(scene_, timeSeconds);
    cameras_ = scene_.cameras;
    scene_.cameras[std::size_t(camera_)] = rig_.camera();
    placeShownCamera();
}

void OpenScene::placeShownCamera() {
    const auto isShown = [&](const scenes::Carried& carried) { return carried.element == camera_; };
    const auto isOfShown = [&](const scenes::RestNumber& rest) {
        return scenes::infoOf(rest.property).owner == scenes::AnimatedOwner::Camera && rest.element == camera_;
    };
    if (std::ranges::none_of(scene_.rig.cameras, isShown) && std::ranges::none_of(scene_.rig.numbers, isOfShown))
        return;
    scenes::Camera start = scenes::changedCamera(sceneCamera(), placed_);
    if (places(placed_)) { // it stands still, and only its lens may change
        start.worldFromCamera = rig_.start().worldFromCamera;
        rig_.startAt(start, rig_.home());
        return applyRig();
    }
    const CameraPose home = poseOf(start, rig_.home().focusMetres);
    if (isLed()) return begin(start, home);
    rig_.startAt(start, home); // it is where it was, and the clip's camera is home
    applyRig();
}

CameraPose OpenScene::poseThrough(const scenes::Camera& camera) const {
    constexpr int kSidePixels = 3; // the middle one looks along the axis
    const auto seen = pickedByRay(scene_, camera, glm::ivec2(kSidePixels), glm::ivec2(kSidePixels / 2));
    if (!seen) return poseOf(camera, boundsWS_);
    const glm::dvec3 forwardWS = -glm::dvec3(camera.worldFromCamera[2]);
    const double focusMetres = glm::dot(seen->positionWS - glm::dvec3(camera.worldFromCamera[3]), forwardWS);
    return focusMetres > 0.0 ? poseOf(camera, focusMetres) : poseOf(camera, boundsWS_);
}

void OpenScene::useCamera(int camera) {
    scene_.cameras[std::size_t(camera_)] = sceneCamera();
    camera_ = camera;
    place(changeForAspect(source_, sceneCamera(), load_.aspect));
}

void OpenScene::keepJump(std::string what, CameraView before) {
    const bool isElsewhere = before.camera != camera_ || !(before.placed == placed_) ||
                             before.rig.pose() != rig_.pose() || !rig_.isAtRest(); // on its way
    if (isElsewhere) history_.keep(std::move(what), CameraEdit{std::move(before)});
}

void OpenScene::jumpToCamera(int camera) {
    CameraView before = view();
    useCamera(camera);
    const std::string& name = sceneCamera().name;
    keepJump(name.empty() ? fmt::format("look through camera {}", camera)
                          : fmt::format("look through camera '{}'", name),
             std::move(before));
}

void OpenScene::jumpHome() {
    CameraView before = view();
    rig_.goHome();
    keepJump("go back to the scene's camera", std::move(before));
}

void OpenScene::jumpToAll(double aspect) {
    CameraView before = view();
    rig_.frameScene(aspect);
    keepJump("bring all into view", std::move(before));
}

void OpenScene::jumpTo(std::string what, const scenes::Box3& boundsWS, double aspect) {
    CameraView before = view();
    rig_.frame(boundsWS, aspect);
    keepJump(std::move(what), std::move(before));
}

void OpenScene::turnAbout(const glm::dvec3& pivotWS) {
    CameraView before = view();
    rig_.turnAbout(pivotWS);
    keepJump("turn about another point", std::move(before));
}

// ---- Edits ----

void OpenScene::apply(std::string what, Edit edit, Gesture gesture) {
    exchange(edit);
    history_.keep(std::move(what), std::move(edit), gesture);
}

void OpenScene::changeLight(std::size_t index, scenes::Light changed, Gesture gesture) {
    const scenes::Light& now = scene_.lights[index];
    if (changed == now) return;
    const std::string label = lightLabel(scene_.lights, index);
    LightsEdit edit{index, 1, {std::move(changed)}};
    edit.links = scenes::linksAfterEdit(scene_.rig, index, now, edit.others.front());
    const Edit* const begun = history_.continued(edit, gesture);
    const scenes::Light& before = begun != nullptr ? std::get<LightsEdit>(*begun).others.front() : now;
    std::string what = changeText(before, edit.others.front(), label);
    apply(std::move(what), std::move(edit), gesture);
}

void OpenScene::changeMaterial(std::size_t index, scenes::Material changed, Gesture gesture) {
    const scenes::Material& now = scene_.materials[index];
    if (changed == now) return;
    const scenes::Material resting = scenes::restingMaterial(scene_, index);
    MaterialEdit edit{index, scenes::editedAtRest(scene_, index, std::move(changed))};
    if (edit.other == resting) return;
    const Edit* const begun = history_.continued(edit, gesture);
    const scenes::Material& before = begun != nullptr ? std::get<MaterialEdit>(*begun).other : resting;
    std::string what = changeText(before, edit.other, now.name.empty() ? fmt::format("{}", index) : now.name);
    apply(std::move(what), std::move(edit), gesture);
}

void OpenScene::changeHookParameter(std::size_t parameter, float value, Gesture gesture) {
    const scenes::HookParameter& now = scene_.hook->parameters[parameter];
    if (value == now.value) return;
    apply(fmt::format("change '{}' of the hook", now.name), HookEdit{parameter, value}, gesture);
}

void OpenScene::replaceLights(std::string what, std::size_t first, std::size_t count, Lights others) {
    LightsEdit edit{first, count, std::move(others)};
    edit.links = scenes::linksAfterReplacing(scene_.rig, first, count, edit.others.size());
    apply(std::move(what), std::move(edit));
}

void OpenScene::deleteLights(std::string what, std::span<const std::size_t> indices) {
    // One step, of the lights from the first that goes to the last, in whose place those come that stay.
    const std::size_t first = indices.front(), end = indices.back() + 1;
    Lights kept;
    for (std::size_t i = first; i < end; ++i)
        if (!std::ranges::binary_search(indices, i)) kept.push_back(scene_.lights[i]);
    LightsEdit edit{first, end - first, std::move(kept)};
    edit.links = scenes::linksAfterDeleting(scene_.rig, indices);
    apply(std::move(what), std::move(edit));
}

void OpenScene::takeEnvironment(ChosenEnvironment chosen) {
    const std::string name = std::filesystem::path(chosen.name).filename().string();
    if (chosen.environment) scenes::layAs(ownEnvironment_, *chosen.environment);
    Surrounding next{std::move(chosen.environment), environmentView_, false,
                     std::move(chosen.filtered),    scene_.warnings,  std::move(chosen.warnings)};
    // What was said of the environment before is over.
    std::erase_if(next.warnings, [&](const std::string& warning) {
        return std::ranges::find(environmentWarnings_, warning) != environmentWarnings_.end();
    });
    next.warnings.insert(next.warnings.end(), next.ownWarnings.begin(), next.ownWarnings.end());
    apply(fmt::format("choose environment '{}'", name), EnvironmentEdit{std::move(next)});
}

void OpenScene::changeEnvironmentView(const scenes::EnvironmentView& changed, Gesture gesture) {
    if (!scene_.environment || changed == environmentView_) return;
    EnvironmentViewEdit edit{scenes::ownViewOf(*scene_.environment), changed};
    std::string what = changeText(environmentView_, changed);
    apply(std::move(what), edit, gesture);
}

const Edit* OpenScene::undo() {
    return history_.undo([this](Edit& edit) { exchangeLater(edit); });
}

const Edit* OpenScene::redo() {
    return history_.redo([this](Edit& edit) { exchangeLater(edit); });
}

void OpenScene::exchangeLater(Edit& edit) {
    exchange(edit);
    if (std::holds_alternative<LightsEdit>(edit)) scenes::restLights(scene_); // another clip may play now
    if (!std::holds_alternative<CameraEdit>(edit)) pose(shownSeconds_);
}

void OpenScene::exchange(Edit& edit) {
    std::visit([this](auto& one) { exchange(one); }, edit);
    ++revision_;
    if (changesScene(edit)) ++edits_;
}

void OpenScene::exchange(LightsEdit& edit) {
    Lights& lights = scene_.lights;
    const auto begin = lights.begin() + std::ptrdiff_t(edit.first), end = begin + std::ptrdiff_t(edit.count);
    Lights taken(std::make_move_iterator(begin), std::make_move_iterator(end));
    const std::size_t put = edit.others.size(), both = std::min(put, edit.count);
    std::move(edit.others.begin(), edit.others.begin() + std::ptrdiff_t(both), begin);
    if (put < edit.count)
        lights.erase(begin + std::ptrdiff_t(both), end);
    else
        lights.insert(begin + std::ptrdiff_t(both), std::make_move_iterator(edit.others.begin() + std::ptrdiff_t(both)),
                      std::make_move_iterator(edit.others.end()));
    edit.count = put;
    edit.others = std::move(taken);
    scenes::LightLinks links = scenes::lightLinks(scene_.rig);
    scenes::setLightLinks(scene_.rig, edit.links);
    edit.links = std::move(links);
}

void OpenScene::exchange(MaterialEdit& edit) {
    scenes::Material before = scenes::restingMaterial(scene_, edit.index);
    scenes::replaceMaterial(scene_, edit.index, std::move(edit.other), shownSeconds_);
    edit.other = std::move(before);
    ++materialRevision_;
}

void OpenScene::exchange(HookEdit& edit) {
    std::swap(scene_.hook->parameters[edit.parameter].value, edit.other);
}

void OpenScene::exchange(EnvironmentEdit& edit) {
    std::swap(scene_.environment, edit.other.environment);
    std::swap(environmentView_, edit.other.view);
    std::swap(scene_.supplied.light, edit.other.isSupplied);
    std::swap(filtered_, edit.other.filtered);
    std::swap(scene_.warnings, edit.other.warnings);
    std::swap(environmentWarnings_, edit.other.ownWarnings);
    ++environmentRevision_;
}

void OpenScene::exchange(EnvironmentViewEdit& edit) {
    const scenes::EnvironmentView own = scenes::ownViewOf(*scene_.environment);
    if (edit.own != own) ++environmentRevision_; // a file was saved in between
    setOwnView(*scene_.environment, std::exchange(edit.own, own));
    std::swap(environmentView_, edit.view);
}

void OpenScene::exchange(CameraEdit& edit) {
    CameraView before = view();
    scene_.cameras[std::size_t(camera_)] = sceneCamera();
    camera_ = edit.other.camera;
    placed_ = edit.other.placed;
    rig_ = std::move(edit.other.rig);
    rig_.moveAs(before.rig);
    applyRig();
    placeShownCamera(); // the clip may have gone on
    edit.other = std::move(before);
}

// ---- The file and the camera ----

void OpenScene::becomes(const std::string& file) {
    scene_.supplied = {}; // the file has it
    history_.forEach([](Edit& edit) {
        if (auto* const surrounding = std::get_if<EnvironmentEdit>(&edit)) surrounding->other.isSupplied = false;
    });
    if (scene_.environment) takeAsSeen();
    source_ = file;
    scenes::LoadOptions load; // the file says the rest
    load.import = std::move(load_.import);
    load.import.variant.reset();
    load_ = std::move(load);
    history_.markSaved();
    cameras_ = loadedCameras_ = scene_.cameras;
    placed_ = {};
    rig_.startHere(sceneCamera());
    scenes::leaveLightsAndCameras(scene_); // the file has them as they are
    const scenes::LightLinks none = scenes::lightLinks(scene_.rig);
    history_.forEach([&](Edit& edit) {
        if (auto* const lights = std::get_if<LightsEdit>(&edit)) lights->links = none;
        auto* const jump = std::get_if<CameraEdit>(&edit);
        if (jump == nullptr || jump->other.camera != camera_) return;
        jump->other.placed = {}; // the file's camera is what it starts as now
        jump->other.rig.startAt(rig_.start(), rig_.home());
    });
}

void OpenScene::takeAsSeen() {
    if (environmentView_ != scenes::EnvironmentView()) ++revision_;
    const auto take = [](std::optional<scenes::Environment>& environment, scenes::EnvironmentView& seenBy) {
        if (environment) setOwnView(*environment, scenes::asSeen(scenes::ownViewOf(*environment), seenBy));
        seenBy = {};
    };
    take(scene_.environment, environmentView_);
    history_.forEach([&](Edit& edit) {
        if (auto* const surrounding = std::get_if<EnvironmentEdit>(&edit))
            take(surrounding->other.environment, surrounding->other.view);
        if (auto* const turn = std::get_if<EnvironmentViewEdit>(&edit))
            *turn = {scenes::asSeen(turn->own, turn->view), {}};
    });
    scenes::askForNoView(scene_.options);
    ownEnvironment_ = scenes::ownEnvironmentOf(scene_);
}

void OpenScene::place(const scenes::CameraChange& change) {
    const scenes::Camera camera = scenes::changedCamera(sceneCamera(), change);
    const glm::dvec3 eyeWS(camera.worldFromCamera[3]);
    placed_ = change;
    begin(camera, change.targetWS ? poseOf(camera, glm::distance(eyeWS, *change.targetWS)) : poseThrough(camera));
}

scenes::CameraChange OpenScene::cameraChange() const {
    if (!rig_.isMoved()) return placed_;
    // The change has eye and target, so it replaces an earlier position; other earlier changes remain.
    scenes::CameraChange change = changeOf(rig_.pose(), rig_.start());
    change.fovYDegrees = placed_.fovYDegrees;
    if (!change.halfHeightMetres) change.halfHeightMetres = placed_.halfHeightMetres;
    if (!change.nearMetres) change.nearMetres = placed_.nearMetres;
    if (!change.farMetres) change.farMetres = placed_.farMetres;
    return change;
}

void OpenScene::begin(const scenes::Camera& start, const CameraPose& home) {
    const CameraRig before = rig_;
    rig_ = CameraRig(start, home, boundsWS_);
    rig_.moveAs(before);
    applyRig();
}

void OpenScene::applyRig() {
    scene_.cameras[std::size_t(camera_)] = rig_.camera();
    ++revision_;
}

} // namespace tessera::viewer
