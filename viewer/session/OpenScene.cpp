#include "viewer/session/OpenScene.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "scenes/Clips.h"
#include "scenes/Framing.h"
#include "scenes/Pose.h"
#include "scenes/Rest.h"
#include "scenes/RigLinks.h"

namespace tessera::viewer {

OpenScene::OpenScene(std::string source, const scenes::LoadOptions& load, scenes::Scene loaded,
                     scenes::SceneOrigin origin, std::shared_ptr<const frame::FilteredEnvironment> filtered,
                     const scenes::EnvironmentView& seen)
    : source_(std::move(source)), load_(load), scene_(std::move(loaded)), origin_(std::move(origin)),
      environment_(scene_, std::move(filtered), seen), boundsWS_(scenes::boundsOverClips(scene_)),
      shown_(scene_, boundsWS_), clipSeconds_(scenes::playingSeconds(scene_.rig)) {}

// ---- Time ----

bool OpenScene::showTime(double timeSeconds) {
    timeSeconds = std::min(timeSeconds, clipSeconds_);
    if (!scenes::isPlaying(scene_) || timeSeconds == requestedSeconds_) return false;
    requestedSeconds_ = timeSeconds;
    if (timeSeconds == shownSeconds_) return false; // after a refused pose
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
    const std::vector<scenes::Camera> cameras = shown_.cameras();
    try {
        shown_.giveBack();
        scenes::playClip(scene_, nameOrNumber);
        shown_.takeOwn(); // at rest
        pose(0.0);
    } catch (...) {
        scene_.lights = lights;
        scene_.cameras = cameras;
        shown_.takeOwn();
        scene_.materials = scenes::restingMaterials(scene_);
        scene_.rig.playing = before;
        pose(shownSeconds_);
        throw;
    }
    load_.clip = scene_.options.clip = nameOrNumber;
    clipSeconds_ = scenes::playingSeconds(scene_.rig);
    requestedSeconds_ = shownSeconds_ = 0.0;
    ++revision_;
    ++geometryRevision_;
    ++materialRevision_;
}

void OpenScene::pose(double timeSeconds) {
    shown_.giveBack(); // clips animate the scene's camera, not the user's
    scenes::poseScene(scene_, timeSeconds);
    shown_.takeUp();
}

// ---- Jumps of the camera ----

void OpenScene::useCamera(int camera) {
    shown_.use(camera, changeForAspect(source_, cameras()[std::size_t(camera)], load_.aspect));
}

void OpenScene::keepJump(std::string what, CameraView before, Gesture gesture) {
    if (shown_.isElsewhere(before)) history_.keep(std::move(what), CameraEdit{std::move(before)}, gesture);
}

void OpenScene::jump(std::string what, const std::function<void()>& begin) {
    CameraView before = shown_.view();
    begin();
    keepJump(std::move(what), std::move(before));
}

void OpenScene::followClipCamera(bool follows) {
    CameraView before = shown_.view();
    if (shown_.followClip(follows)) keepJump("follow the clip's camera", std::move(before));
}

void OpenScene::jumpToCamera(int camera) {
    const std::string& name = cameras()[std::size_t(camera)].name;
    jump(name.empty() ? fmt::format("look through camera {}", camera) : fmt::format("look through camera '{}'", name),
         [&] { useCamera(camera); });
}

void OpenScene::jumpHome() {
    jump("go back to the scene's camera", [&] { rig().goHome(); });
}

void OpenScene::jumpToAll(double aspect) {
    jump("bring all into view", [&] { rig().frameScene(aspect); });
}

void OpenScene::jumpTo(std::string what, const scenes::Box3& boundsWS, double aspect) {
    jump(std::move(what), [&] { rig().frame(boundsWS, aspect); });
}

void OpenScene::jumpToHeading(std::string what, const Heading& heading, double aspect) {
    jump(std::move(what), [&] { rig().look(heading, aspect); });
}

void OpenScene::moveCamera(const CameraPose& pose, Gesture gesture) {
    CameraView before = shown_.view();
    rig().jumpTo(pose);
    applyRig();
    keepJump("move the camera", std::move(before), gesture);
}

void OpenScene::changeFieldOfView(double degrees, Gesture gesture) {
    CameraView before = shown_.view();
    shown_.changeFieldOfView(degrees);
    keepJump("change the field of view", std::move(before), gesture);
}

void OpenScene::storeViewpoint() {
    const auto isTaken = [this](const std::string& name) {
        const auto isCalled = [&](const scenes::Camera& camera) { return camera.name == name; };
        return std::ranges::any_of(cameras(), isCalled) || std::ranges::any_of(viewpoints_, isCalled);
    };
    ViewpointsEdit edit{viewpoints_};
    scenes::Camera& stored = edit.others.emplace_back(rig().camera());
    for (int number = 1; number == 1 || isTaken(stored.name); ++number) stored.name = fmt::format("view {}", number);
    std::string what = fmt::format("store '{}'", stored.name);
    apply(std::move(what), std::move(edit));
}

void OpenScene::removeViewpoint(std::size_t index) {
    ViewpointsEdit edit{viewpoints_};
    edit.others.erase(edit.others.begin() + std::ptrdiff_t(index));
    apply(fmt::format("remove '{}'", viewpoints_[index].name), std::move(edit));
}

void OpenScene::jumpToViewpoint(std::size_t index) {
    const scenes::Camera& stored = viewpoints_[index];
    jump(fmt::format("go to '{}'", stored.name), [&] { shown_.goTo(stored); });
}

void OpenScene::turnAbout(const glm::dvec3& pivotWS) {
    jump("turn about another point", [&] { rig().turnAbout(pivotWS); });
}

// ---- Edits ----

void OpenScene::apply(std::string what, Edit edit, Gesture gesture) {
    exchange(edit);
    history_.keep(std::move(what), std::move(edit), gesture);
}

void OpenScene::changeLight(std::size_t index, scenes::Light changed, Gesture gesture) {
    changeLights({{index, std::move(changed)}}, gesture);
}

void OpenScene::changeLights(const std::map<std::size_t, scenes::Light>& changed, Gesture gesture) {
    const Lights& lights = scene_.lights;
    if (std::ranges::all_of(changed, [&](const auto& one) { return one.second == lights[one.first]; })) return;
    // Covers all lights from the first changed one to the last.
    const std::size_t first = changed.begin()->first, count = changed.rbegin()->first + 1 - first;
    const std::span<const scenes::Light> now = std::span(lights).subspan(first, count);
    LightsEdit edit{first, count, Lights(now.begin(), now.end())};
    for (const auto& [index, light] : changed) edit.others[index - first] = light;
    edit.links = scenes::linksAfterEdit(scene_.rig, first, now, edit.others);
    const Edit* const begun = history_.continued(edit, gesture);
    const std::span<const scenes::Light> before = begun != nullptr ? std::get<LightsEdit>(*begun).others : now;
    const auto differing = std::ranges::mismatch(before, edit.others);
    const bool isAny = differing.in1 != before.end(); // a drag may have returned to its start
    const scenes::Light& was = isAny ? *differing.in1 : before.front();
    const scenes::Light& is = isAny ? *differing.in2 : edit.others.front();
    std::string what =
        changed.size() == 1 ? changeText(was, is, lightLabel(lights, first)) : changeText(was, is, changed.size());
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
    // One step: replaces the lights from the first to the last deleted one by those that are kept.
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
    apply(fmt::format("choose environment '{}'", name), EnvironmentEdit{environment_.replacedBy(std::move(chosen))});
}

void OpenScene::changeEnvironmentView(const scenes::EnvironmentView& changed, Gesture gesture) {
    if (!scene_.environment || changed == environmentView()) return;
    EnvironmentViewEdit edit{scenes::ownViewOf(*scene_.environment), changed};
    std::string what = changeText(environmentView(), changed);
    apply(std::move(what), edit, gesture);
}

const Edit* OpenScene::undo() {
    return history_.undo([this](Edit& edit) { exchangeLater(edit); });
}

const Edit* OpenScene::redo() {
    return history_.redo([this](Edit& edit) { exchangeLater(edit); });
}

void OpenScene::step(std::ptrdiff_t steps) {
    for (; steps < 0; ++steps) undo();
    for (; steps > 0; --steps) redo();
}

/// Whether a scene that was just loaded matches this one, in its saved state, in everything that the history changes or
/// indexes.
bool OpenScene::isLike(const scenes::Scene& loaded) const {
    const auto isSameLight = [](const scenes::Light& one, const scenes::Light& other) {
        return one.name == other.name && one.type == other.type;
    };
    const auto isSameParameter = [](const scenes::HookParameter& one, const scenes::HookParameter& other) {
        return one.name == other.name;
    };
    // Edits of lights identify the lights that clips animate by these.
    const auto isSameNumber = [](const scenes::RestNumber& one, const scenes::RestNumber& other) {
        return one.property == other.property && one.element == other.element && one.slot == other.slot;
    };
    const auto parameters = [](const scenes::Scene& scene) {
        return scene.hook ? std::span(scene.hook->parameters) : std::span<const scenes::HookParameter>();
    };
    return std::ranges::equal(scene_.lights, loaded.lights, isSameLight) &&
           scene_.cameras.size() + viewpoints_.size() == loaded.cameras.size() &&
           scene_.environment.has_value() == loaded.environment.has_value() &&
           std::ranges::equal(parameters(scene_), parameters(loaded), isSameParameter) &&
           std::ranges::equal(scene_.rig.numbers, loaded.rig.numbers, isSameNumber) &&
           history_.allOf([&](const Edit& edit) {
               const auto* const material = std::get_if<MaterialEdit>(&edit);
               return material == nullptr || (material->index < loaded.materials.size() &&
                                              scenes::restingMaterial(scene_, material->index) ==
                                                  scenes::restingMaterial(loaded, material->index));
           });
}

bool OpenScene::canGoOnAs(const scenes::Scene& loaded) {
    const std::optional<std::ptrdiff_t> steps = history_.stepsToSaved();
    if (!steps) return false;
    step(*steps);
    const bool can = isLike(loaded);
    step(-*steps);
    return can;
}

void OpenScene::goOnFrom(OpenScene& other) {
    const std::ptrdiff_t steps = other.history_.stepsToSaved().value();
    other.step(steps);
    history_ = std::exchange(other.history_, {});
    viewpoints_ = other.viewpoints_;
    shown_.removeLast(viewpoints_.size()); // the file has them as cameras
    // Steps of the camera and of the environment's view exchange values with the other scene's saved state.
    if (scene_.environment) {
        scenes::EnvironmentView own = scenes::ownViewOf(*scene_.environment), view = other.environmentView();
        environment_.exchange(own, view);
    }
    CameraView here = shown_.view(), before = other.shown_.view();
    shown_.exchange(before);
    step(-steps);
    shown_.exchange(here);
}

void OpenScene::exchangeLater(Edit& edit) {
    exchange(edit);
    if (std::holds_alternative<LightsEdit>(edit)) scenes::restLights(scene_); // another clip may play now
    if (!std::holds_alternative<CameraEdit>(edit)) pose(shownSeconds_);
}

void OpenScene::exchange(Edit& edit) {
    if (isSeen(edit)) {
        ++revision_;
        if (changesScene(edit)) ++pictureEdits_;
    }
    std::visit([this](auto& one) { exchange(one); }, edit);
    if (changesScene(edit)) ++edits_;
}

/// Whether the edit changes the image; names of lights and stored viewpoints do not.
bool OpenScene::isSeen(const Edit& edit) const {
    if (std::holds_alternative<ViewpointsEdit>(edit)) return false;
    const auto* const lights = std::get_if<LightsEdit>(&edit);
    return lights == nullptr || !std::ranges::equal(std::span(scene_.lights).subspan(lights->first, lights->count),
                                                    lights->others, [](scenes::Light one, const scenes::Light& other) {
                                                        one.name = other.name;
                                                        return one == other;
                                                    });
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

// ---- The file ----

void OpenScene::becomes(const std::string& file) {
    scene_.supplied = {}; // the file contains what was supplied
    history_.forEach([](Edit& edit) {
        if (auto* const surrounding = std::get_if<EnvironmentEdit>(&edit)) surrounding->other.isSupplied = false;
    });
    if (scene_.environment) takeAsSeen();
    source_ = file;
    scenes::LoadOptions load; // the file specifies the rest
    load.import = std::move(load_.import);
    load.import.variant.reset();
    load_ = std::move(load);
    history_.markSaved();
    shown_.becomeOwn();
    scenes::leaveLightsAndCameras(scene_); // the file has them as they are
    const scenes::LightLinks none = scenes::lightLinks(scene_.rig);
    history_.forEach([&](Edit& edit) {
        if (auto* const lights = std::get_if<LightsEdit>(&edit)) lights->links = none;
        auto* const jump = std::get_if<CameraEdit>(&edit);
        if (jump == nullptr || jump->other.camera != camera()) return;
        jump->other.placed = {}; // the rig now starts with the file's camera
        jump->other.rig.startAt(rig().start(), rig().home());
    });
}

void OpenScene::takeAsSeen() {
    if (environmentView() != scenes::EnvironmentView()) ++revision_;
    environment_.takeAsSeen();
    history_.forEach([](Edit& edit) {
        if (auto* const surrounding = std::get_if<EnvironmentEdit>(&edit)) surrounding->other.takeAsSeen();
        if (auto* const turn = std::get_if<EnvironmentViewEdit>(&edit))
            *turn = {scenes::asSeen(turn->own, turn->view), {}};
    });
}

} // namespace tessera::viewer
