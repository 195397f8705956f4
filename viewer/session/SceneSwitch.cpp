#include "viewer/session/SceneSwitch.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/ChooseView.h"
#include "scenes/import/MadeImages.h"
#include "viewer/session/MapChoices.h"
#include "viewer/session/Remember.h"
#include "viewer/session/SceneSource.h"

namespace tessera::viewer {
namespace {

/// The requested change of a supplied camera, completed by its full placement: a command with another image size would
/// supply another camera.
scenes::CameraChange placeOfSupplied(const scenes::Camera& camera, const scenes::CameraChange& said,
                                     const scenes::Box3& boundsWS) {
    const scenes::CameraChange place = changeOf(poseOf(scenes::changedCamera(camera, said), boundsWS), camera);
    scenes::CameraChange change = said;
    const auto complete = [](auto& one, const auto& other) {
        if (!one) one = other;
    };
    complete(change.eyeWS, place.eyeWS);
    complete(change.targetWS, place.targetWS);
    complete(change.upWS, place.upWS);
    complete(change.nearMetres, place.nearMetres);
    complete(change.farMetres, place.farMetres);
    return change;
}

/// Summary of a scene's warnings and supplied parts; empty without either. The panel Scene shows all of it.
std::string loadNote(const scenes::Scene& scene) {
    static constexpr std::size_t kMostCounted = 100; // files may have any number
    const std::size_t warnings = scene.warnings.size();
    const auto pictures = std::size_t(std::ranges::count_if(
        scene.warnings, [](const std::string& warning) { return warning.ends_with(scenes::kStandInText); }));
    const auto counted = [](std::size_t count, std::string_view what) {
        return count > kMostCounted ? fmt::format("over {} {}s", kMostCounted, what)
                                    : fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
    };
    std::vector<std::string> parts, given;
    if (pictures > 0) parts.push_back(counted(pictures, "picture") + " missing, shown by a checkerboard");
    if (warnings > pictures) parts.push_back(counted(warnings - pictures, pictures > 0 ? "other warning" : "warning"));
    if (scene.supplied.light) given.emplace_back("environment");
    if (scene.supplied.camera) given.emplace_back("camera");
    if (scene.supplied.exposureEV != 0) given.emplace_back("exposure");
    if (!given.empty()) parts.push_back(fmt::format("supplied: {}", fmt::join(given, ", ")));
    return parts.empty() ? std::string() : fmt::format("{} (see the panel Scene)", fmt::join(parts, "; "));
}

} // namespace

SceneSwitch::SceneSwitch(const ViewerOptions& options, State& state, const EventLog& log, std::function<void()> done)
    : options_(options), state_(state), log_(log), preferences_(options.preferences), loader_(std::move(done)) {
    recall(preferences_, state_);
}

void SceneSwitch::open(const std::string& source, const scenes::LoadOptions& load) {
    isFirstLoad_ = !wasOpened_;
    wasOpened_ = true;
    scenes::LoadOptions options = load;
    options.defaultLight = load.defaultLight && options_.load.defaultLight;
    const auto left = left_.find(identityOf(source));
    if (!options.aspect) options.aspect = left != left_.end() ? left->second.aspect : state_.pictureAspect;
    loader_.start(source, options);
    state_.loading = source;
    log_.line("loading " + source);
}

void SceneSwitch::discard() {
    loader_.take();
    state_.loading.clear();
}

std::unique_ptr<OpenScene> SceneSwitch::take(const std::function<void(const OpenScene& scene)>& show) {
    std::optional<SceneLoader::Result> result = loader_.take();
    if (!result) return nullptr;
    state_.loading.clear();
    if (!result->scene) throw std::runtime_error(result->error);
    const FirstLook first = options_.lookOf(*result->scene, result->source, isFirstLoad_);
    const bool isSupplied = result->scene->supplied.camera;
    auto scene =
        std::make_unique<OpenScene>(result->source, result->load, std::move(*result->scene), std::move(*result->origin),
                                    std::move(result->filtered), environmentSeenBy(first.look));
    scene->useCamera(first.look.settings.camera);
    const scenes::Camera& camera = scene->cameras()[std::size_t(first.look.settings.camera)];
    if (isSupplied)
        scene->place(placeOfSupplied(camera, first.pose, scene->boundsWS()));
    else if (first.pose != scenes::CameraChange())
        scene->place(first.pose);
    show(*scene);
    // From here on nothing fails.
    if (hadScene_) rememberLook(preferences_, state_.looks[0], base_);
    for (Look& look : state_.looks) look = hadScene_ ? rebased(look, base_, first.look) : first.look;
    // Another scene begins at its own time.
    if (!state_.open || identityOf(state_.open->source()) != identityOf(scene->source()))
        for (Look& look : state_.looks) look.settings.timeSeconds = first.look.settings.timeSeconds;
    state_.viewEnvironmentBy(scene->environmentView()); // turning the previous environment was an edit of that scene
    // The other side of a comparison begins with a technique of the other kind (forward, deferred), as fast with many
    // lights.
    if (!hadScene_)
        state_.looks[1].technique = infoOf(first.look.technique).usesGBuffer() ? engine::Technique::ClusteredForward
                                                                               : engine::Technique::ClusteredDeferred;
    state_.looks[1] = possible(state_.looks[1]);
    // The new scene may lack the channel that was displayed.
    if (hadScene_)
        for (Look& look : state_.looks)
            if (!engine::storesShown(frame::makeFrameSpec(scene->scene(), {}, look.settings)))
                look.settings.view = frame::DebugView::Final;
    base_ = first.look;
    hadScene_ = true;
    if (state_.open) {
        scene->rig().moveAs(state_.open->rig());
        leave(*state_.open);
    }
    comeBack(*scene);
    state_.selectedLight = state_.selectedMaterial = scenes::kNone;
    state_.types.forget();
    state_.listing = {};
    state_.listed.reset();
    state_.magnification = {};
    state_.pins.clear();
    if (state_.resource.image) state_.resource = {};
    state_.renamed.reset();
    if (!state_.notice.outlivesLoad) state_.notice = {loadNote(scene->scene())};
    state_.shaderFaults.clear();
    log_.line(fmt::format("opened {} seconds {:.2f}", result->source, result->seconds));
    noteRecent(state_.recent, result->source);
    noteMap(state_.maps, scene->scene());
    return scene;
}

void SceneSwitch::leave(const OpenScene& scene) {
    Left left{
        scene.camera(), scene.loadedCameras()[std::size_t(scene.camera())], scene.placed(), {}, scene.load().aspect};
    if (scene.rig().isMoved()) left.pose = scene.rig().pose();
    left_[identityOf(scene.source())] = left;
}

void SceneSwitch::comeBack(OpenScene& scene) {
    const auto found = left_.find(identityOf(scene.source()));
    if (found == left_.end()) return;
    const Left& left = found->second;
    const std::vector<scenes::Camera>& cameras = scene.loadedCameras(); // the file may have changed since
    if (left.index >= int(cameras.size()) || cameras[std::size_t(left.index)] != left.camera) return;
    scene.useCamera(left.index);
    scene.place(left.placed);
    if (left.pose) scene.rig().jumpTo(*left.pose);
    scene.applyRig();
    for (Look& look : state_.looks) look.settings.camera = left.index;
}

void SceneSwitch::remember(glm::ivec2 windowSize) {
    if (!options_.preferencesFile) return;
    Preferences now = preferences_; // a setting may yet return to the open scene's initial value
    viewer::remember(now, state_, base_, windowSize);
    if (now == written_) return;
    try {
        writePreferences(now, *options_.preferencesFile);
        written_ = std::move(now);
    } catch (const std::exception& error) {
        if (std::exchange(fault_, error.what()) != error.what()) options_.warn(error.what());
    }
}

} // namespace tessera::viewer
