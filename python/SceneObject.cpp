#include "python/SceneObject.h"

#include <mutex>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "apps/FrameOptionText.h"
#include "apps/Keywords.h"
#include "base/OneLine.h"
#include "scenes/Clips.h"
#include "scenes/Defaults.h"

namespace tessera::python {

/// The part of a scene owned by the worker.
struct SceneObject::Slot {
    std::optional<LoadedScene> loaded;

    Slot() = default;
    ~Slot() { all().erase(this); }
    Slot(const Slot&) = delete;
    Slot& operator=(const Slot&) = delete;

    /// All slots that may hold a loaded scene. On the worker's thread.
    static std::set<Slot*>& all() {
        static std::set<Slot*> slots;
        return slots;
    }
    static void dropAll() {
        for (Slot* slot : std::exchange(all(), {})) slot->loaded.reset();
    }
};

namespace {

/// The aspect ratio as text, in lowest terms: the only part of a size that a load depends on.
std::string aspectText(const std::string& size) {
    const glm::ivec2 pixels = app::sizeNamed("--size", size);
    const int common = std::gcd(pixels.x, pixels.y);
    return fmt::format("{}x{}", pixels.x / common, pixels.y / common);
}

/// The options that a load depends on, as text.
std::string loadText(const app::FrameOptions& options, bool isPlaying) {
    app::FrameOptions ofLoad = options;
    ofLoad.settings.clear();
    if (const auto size = options.said("size")) ofLoad.settings["size"] = aspectText(*size);
    if (options.pose != scenes::CameraChange()) { // the pose applies to the selected camera at its current position
        if (const auto camera = options.said("camera")) ofLoad.settings["camera"] = *camera;
        if (const auto time = options.said("time"); time && isPlaying) ofLoad.settings["time"] = *time;
    }
    return options.scene + app::frameOptionText(ofLoad) + " " + options.memoryLimit.value_or("");
}

} // namespace

engine::Renderer& LoadedScene::rendererOn(gpu::Context& context) {
    if (!renderer) renderer = std::make_unique<engine::Renderer>(context, request.scene);
    return *renderer;
}

void LoadedScene::pose(const std::string& file) {
    const double timeSeconds = request.settings.timeSeconds;
    if (posedAtSeconds == timeSeconds || !scenes::isPlaying(request.scene)) return;
    posedAtSeconds.reset(); // undefined if posing fails
    app::poseAt(request.scene, timeSeconds, file);
    if (renderer) renderer->partsMoved(scenes::movingParts(request.scene));
    posedAtSeconds = timeSeconds;
}

SceneObject::SceneObject(app::FrameOptions options) : options_(std::move(options)), slot_(new Slot) {
    static std::once_flag isRegistered;
    std::call_once(isRegistered, [] { Worker::get().atEnd([] { Slot::dropAll(); }); });
}

SceneObject::~SceneObject() {
    Worker::get().destroyThere([slot = slot_] { delete slot; });
}

LoadedScene& SceneObject::resolved(const app::FrameOptions& options, const Job& job) {
    // Finds mistakes in the options before a large scene is read.
    app::Request request = app::resolveWithoutScene(options);
    std::optional<LoadedScene>& loaded = slot_->loaded;
    if (!loaded || loadText(options, scenes::isPlaying(loaded->request.scene)) != loaded->asLoaded) {
        loaded.reset(); // memory may not hold two scenes
        Slot::all().insert(slot_);
        std::vector<std::string> files;
        try {
            request.scene = app::loadFor(options, &files, job.stop());
        } catch (const scenes::LoadStopped&) {
            throw Stopped();
        }
        app::warnOfScene(request.scene);
        loaded.emplace();
        loaded->asLoaded = loadText(options, scenes::isPlaying(request.scene));
        loaded->request.scene = std::move(request.scene);
        loaded->request.files = std::move(files);
    }
    static_cast<engine::ViewRequest&>(loaded->request) = static_cast<const engine::ViewRequest&>(request);
    app::resolveForScene(options, loaded->request);
    loaded->pose(options.scene);
    return *loaded;
}

void SceneObject::drop() {
    slot_->loaded.reset();
}

SceneFacts factsOf(const app::Request& request) {
    const scenes::Scene& scene = request.scene;
    SceneFacts facts{scene.name, scenes::triangleCount(scene), scene.lights.size(), scene.materials.size(), {}, {}, {}};
    for (const scenes::Camera& camera : scene.cameras) facts.cameras.push_back(camera.name);
    if (std::string supplied = scenes::suppliedText(scene); !supplied.empty())
        facts.notes.push_back(app::withKeywords(supplied));
    for (const std::string& note : scene.notes) facts.notes.push_back(oneLine(note)); // as the command line prints them
    facts.files = request.files;
    return facts;
}

} // namespace tessera::python
