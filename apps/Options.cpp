#include "apps/Options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "apps/Numbers.h"
#include "passes/recipes/ChooseSamples.h"
#include "scenes/Defaults.h"
#include "scenes/Error.h"
#include "scenes/Names.h"
#include "scenes/OneLine.h"

namespace tessera::app {

namespace {

/// The row of `table` called `name`, or InputError with the nearest names.
template <typename Table>
const auto& rowNamed(const Table& table, const std::string& name, std::string_view kind) {
    std::vector<std::string_view> names;
    for (const auto& row : table) {
        if (row.name == name) return row;
        names.push_back(row.name);
    }
    throw InputError(fmt::format("unknown {} '{}': {}", kind, name, suggestNames(name, names)));
}

template <typename Table>
std::string namesOf(const Table& table) {
    std::string names;
    for (const auto& row : table) names += (names.empty() ? "" : ", ") + std::string(row.name);
    return names;
}

struct NamedSwitch {
    std::string_view name;
    bool on;
};
constexpr NamedSwitch kSwitch[] = {{"on", true}, {"off", false}};

struct NamedContext {
    std::string_view name;
    gpu::ContextKind kind;
};
constexpr NamedContext kContexts[] = {
    {"auto", gpu::ContextKind::Auto}, {"window", gpu::ContextKind::Window}, {"egl", gpu::ContextKind::Egl}};

int cameraNamed(const scenes::Scene& scene, const std::string& name) {
    if (const std::optional<std::size_t> camera = scenes::cameraCalled(scene, name)) return int(*camera);
    std::vector<std::string_view> names;
    for (const scenes::Camera& camera : scene.cameras) names.push_back(camera.name);
    throw InputError(fmt::format("{}: unknown camera '{}': {}", scene.name, name, suggestNames(name, names)));
}

/// Those of the G-buffer's channels as one pattern.
std::string viewNames() {
    std::string names;
    for (const frame::ViewInfo& info : frame::viewTable())
        if (!info.needsGBuffer) names += std::string(info.name) + ", ";
    return names + "or gbuffer.CHANNEL and gbuffer.CHANNEL.w as stored, CHANNEL one of " +
           namesOf(frame::channelTable());
}

frame::View viewNamed(const std::string& name) {
    for (const frame::ViewInfo& info : frame::viewTable()) {
        if (info.key != 0 && std::to_string(info.key) == name) return info.view;
    }
    const bool isNumber = !name.empty() && name.find_first_not_of("0123456789") == std::string::npos;
    if (isNumber) throw InputError(fmt::format("unknown view '{}': views are numbered 1 to 7", name));
    return rowNamed(frame::viewTable(), name, "view").view;
}

/// 2^EV must be a number a picture can be multiplied by.
float exposureOf(double exposureEV) {
    constexpr double kMostEV = 120.0; // fp32 spans 2^-126 to 2^128
    if (std::abs(exposureEV) > kMostEV)
        throw InputError(
            fmt::format("--exposure {} is beyond any picture; give -{} to {}", exposureEV, kMostEV, kMostEV));
    return float(exposureEV);
}

int tileOf(int pixels) {
    if (std::find(std::begin(culling::kTileSides), std::end(culling::kTileSides), pixels) ==
        std::end(culling::kTileSides))
        throw InputError(
            fmt::format("--tile {}: tiles are {} pixels wide", pixels, fmt::join(culling::kTileSides, ", ")));
    return pixels;
}

double rangeToleranceOf(double tolerance) {
    if (tolerance < 0.0)
        throw InputError(
            fmt::format("--range-tolerance {} is below 0; give 0, which ends no light, or more", tolerance));
    return tolerance;
}

/// 512M, 4G: a whole number of bytes, or of 2^10, 2^20, 2^30 of them.
std::uint64_t bytesNamed(const std::string& text) {
    struct Unit {
        char letter;
        int bits;
    };
    constexpr Unit kUnits[] = {{'K', 10}, {'M', 20}, {'G', 30}};
    const char* end = text.data() + text.size();
    std::uint64_t number = 0;
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    int bits = rest == end ? 0 : -1;
    for (const Unit& unit : kUnits)
        if (end - rest == 1 && *rest == unit.letter) bits = unit.bits;
    if (error != std::errc() || bits < 0 || number == 0 || number > std::numeric_limits<std::uint64_t>::max() >> bits)
        throw InputError(
            fmt::format("--memory-limit '{}' is no size; give bytes, or K, M or G of them, as in 4G", text));
    return number << bits;
}

/// What can be read without the scene: a mistake in it is found before a large scene is read for nothing.
void resolveOptions(const FrameOptions& options, Request& request) {
    frame::FrameSettings& settings = request.settings;
    if (options.technique) request.technique = techniqueNamed(*options.technique);
    if (options.layout) settings.layout = rowNamed(frame::layoutTable(), *options.layout, "layout").layout;
    if (options.toneMap) settings.toneMap = rowNamed(frame::toneMapTable(), *options.toneMap, "tone map").toneMap;
    if (options.size) settings.sizePixels = sizeNamed(*options.size);
    if (options.exposureEV) settings.exposureEV = exposureOf(*options.exposureEV);
    if (options.view) settings.view = viewNamed(*options.view);
    if (options.filter) settings.filter = rowNamed(frame::textureFilterTable(), *options.filter, "--filter").filter;
    if (options.space) settings.space = rowNamed(frame::lightingSpaceTable(), *options.space, "--space").space;
    if (options.prune) settings.prune = rowNamed(kSwitch, *options.prune, "--prune").on;
    if (options.specular) settings.specular = rowNamed(kSwitch, *options.specular, "--specular").on;
    if (options.culling)
        settings.culling.method = rowNamed(culling::methodTable(), *options.culling, "--culling").method;
    if (options.tile) settings.culling.tilePixels = tileOf(*options.tile);
    if (options.cullOn)
        settings.culling.builder = rowNamed(culling::builderTable(), *options.cullOn, "--cull-on").builder;
    if (options.samples) {
        recipes::requireSampleCount(*options.samples);
        settings.samples = *options.samples;
    }
    if (options.lightOn) settings.lightOn = rowNamed(frame::lightingStageTable(), *options.lightOn, "--light-on").stage;
    settings.rangeTolerance = rangeToleranceOf(options.rangeTolerance.value_or(0.0));
    settings.timeSeconds = options.timeSeconds.value_or(0.0);
    settings.soloLight = options.solo;
    if (options.memoryLimit) bytesNamed(*options.memoryLimit);
}

/// What the scene wishes where the user says nothing, and the names of things in the scene.
void resolveWishes(const FrameOptions& options, Request& request) {
    const scenes::SceneOptions& wish = request.scene.options;
    frame::FrameSettings& settings = request.settings;
    const auto wished = [&](const char* key, const auto& said, const auto& wanted, auto&& take) {
        if (said || !wanted) return;
        try {
            take(*wanted);
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}:/options/{}: {}", options.scene, key, error.what()));
        }
    };
    wished("technique", options.technique, wish.technique,
           [&](const std::string& name) { request.technique = techniqueNamed(name); });
    wished("layout", options.layout, wish.layout,
           [&](const std::string& name) { settings.layout = rowNamed(frame::layoutTable(), name, "layout").layout; });
    wished("toneMap", options.toneMap, wish.toneMap, [&](const std::string& name) {
        settings.toneMap = rowNamed(frame::toneMapTable(), name, "tone map").toneMap;
    });
    wished("camera", options.camera, wish.camera,
           [&](const std::string& name) { settings.camera = cameraNamed(request.scene, name); });
    wished("size", options.size, wish.sizePixels, [&](glm::ivec2 size) { settings.sizePixels = size; });
    wished("exposureEV", options.exposureEV, wish.exposureEV,
           [&](float exposureEV) { settings.exposureEV = exposureEV; });
    if (options.camera) settings.camera = cameraNamed(request.scene, *options.camera);
    const std::size_t lightCount = request.scene.lights.size();
    if (options.solo && (*options.solo < 0 || std::size_t(*options.solo) >= lightCount)) {
        throw InputError(fmt::format("--solo {}: {} has {} light{}, counted from 0", *options.solo, request.scene.name,
                                     lightCount, lightCount == 1 ? "" : "s"));
    }
}

} // namespace

void addGlobalOptions(CLI::App& app, GlobalOptions& options) {
    app.add_flag("--quiet", options.quiet, "Errors only: no warnings, no progress");
    app.add_flag("--verbose", options.verbose, "More detail; with --version the OpenGL strings");
    const auto check = [&options](const std::string& name) {
        contextKind(name);
        options.context = name;
    };
    app.add_option_function<std::string>(
           "--context", check,
           "Where pictures are made: window, egl (needs no display), or auto, which tries "
           "egl first [auto]")
        ->type_name("KIND");
}

gpu::ContextKind contextKind(const std::string& name) {
    return rowNamed(kContexts, name, "context").kind;
}

std::unique_ptr<gpu::Context> makeContext(const GlobalOptions& options) {
    gpu::ContextOptions contextOptions;
    contextOptions.kind = contextKind(options.context);
    std::unique_ptr<gpu::Context> context = gpu::Context::create(contextOptions);
    spdlog::debug("{} by {}", context->capabilities().renderer, context->capabilities().contextWay);
    return context;
}

void addFrameOptions(CLI::App& command, FrameOptions& options, const std::string& defaultScene) {
    options.scene = defaultScene;
    const std::string preset = defaultScene.empty() ? "" : " [" + defaultScene + "]";
    CLI::Option* scene = command.add_option(
        "scene", options.scene, "A .gltf, .glb, .obj or .json file, or a built-in scene (tessera scenes)" + preset);
    scene->type_name("SCENE");
    if (defaultScene.empty()) scene->required();
    addFrameSettings(command, options);
}

void addFrameSettings(CLI::App& command, FrameOptions& options) {
    const auto text = [&](const char* flag, std::optional<std::string>& target, const std::string& help,
                          const char* type, const char* group = "Frame") {
        command.add_option(flag, target, help)->type_name(type)->group(group);
    };
    text("--technique", options.technique, "One of " + namesOf(recipes::techniqueTable()) + " [deferred]", "NAME");
    text("--layout", options.layout, "G-buffer layout, one of " + namesOf(frame::layoutTable()) + " [exact]", "NAME");
    text("--culling", options.culling,
         "How lights are culled, one of " + namesOf(culling::methodTable()) + " [the technique's own]", "NAME");
    addWholeNumber(command, "--tile", options.tile, "Side of a light-culling tile, 8, 16, 32 or 64 [16]", "PIXELS")
        ->group("Frame");
    text("--cull-on", options.cullOn,
         "Who builds the light lists, one of " + namesOf(culling::builderTable()) + " [by backend]", "NAME");
    text("--light-on", options.lightOn,
         "What lights the G-buffer, one of " + namesOf(frame::lightingStageTable()) + " [fragment]", "NAME");
    text("--size", options.size, "Picture size in pixels [1280x720]", "WxH");
    addWholeNumber(command, "--samples", options.samples,
                   "Samples of a pixel, 1, 2 or 4; more than 1 without a G-buffer only [1]", "N")
        ->group("Frame");
    text("--camera", options.camera, "A camera of the scene, by name or counted from 0 [its first]", "NAME");
    addNumber(command, "--time", options.timeSeconds, "Moves animated lights to this time [0]", "SECONDS")
        ->group("Frame");
    addWholeNumber(command, "--lights", options.lights,
                   "Built-in scenes make this many lights, files keep their first N", "N")
        ->group("Frame");
    addNumber(command, "--range-tolerance", options.rangeTolerance,
              "Ends lights of A B C falloff where they fall to this; compare tells what it drops [0]", "EPS")
        ->group("Frame");
    text("--view", options.view, "What to show: 1 to 7, or one of " + viewNames() + " [final]", "NAME");
    addWholeNumber(command, "--solo", options.solo, "Only this light shines, counted from 0", "N")->group("Frame");
    text("--specular", options.specular, "off leaves the specular lobe out [on]", "on|off");
    text("--filter", options.filter,
         "Textures by hardware, or exact: level 0 alone, by the sampler's nearest or linear filter in full precision "
         "[hardware]",
         "NAME");
    text("--space", options.space, "Lighting in world or view space; the pictures agree [world]", "NAME");
    text("--prune", options.prune, "off keeps what the scene does not need; the picture is the same [on]", "on|off");
    command.add_flag("--no-default-light", options.noDefaultLight, "Leaves a scene without lights dark")
        ->group("Frame");
    text("--memory-limit", options.memoryLimit, "The most memory that reading a scene may take [half of the machine's]",
         "SIZE", "Reading");
    addPoint(command, "--eye", options.pose.eyeWS, "Moves the camera there; alone it looks the same way", "X,Y,Z")
        ->group("Camera");
    addPoint(command, "--target", options.pose.targetWS, "Turns the camera to look there", "X,Y,Z")->group("Camera");
    addPoint(command, "--up", options.pose.upWS, "What is up in the picture [0,1,0 where the camera turns]", "X,Y,Z")
        ->group("Camera");
    addNumber(command, "--fov", options.pose.fovYDegrees, "Vertical field of view of a perspective camera", "DEGREES")
        ->group("Camera");
    addNumber(command, "--half-height", options.pose.halfHeightMetres,
              "Half the height of what an orthographic camera sees", "METRES")
        ->group("Camera");
    addNumber(command, "--near", options.pose.nearMetres, "Nothing nearer is drawn", "METRES")->group("Camera");
    addNumber(command, "--far", options.pose.farMetres, "Nothing farther is drawn", "METRES")->group("Camera");
    addNumber(command, "--exposure", options.exposureEV, "Multiplies the display picture by 2^EV [0]", "EV")
        ->group("Display");
    text("--tonemap", options.toneMap, "One of " + namesOf(frame::toneMapTable()) + " [none]", "NAME", "Display");
}

scenes::LoadOptions loadOptionsOf(const FrameOptions& options) {
    scenes::LoadOptions load;
    load.lights = options.lights;
    load.defaultLight = !options.noDefaultLight;
    if (options.memoryLimit) load.memoryLimitBytes = bytesNamed(*options.memoryLimit);
    return load;
}

scenes::Scene loadFor(const FrameOptions& options, std::vector<std::string>* files) {
    scenes::LoadOptions load = loadOptionsOf(options);
    load.files = files;
    scenes::Scene scene = scenes::loadScene(options.scene, load);
    placeCamera(options, scene);
    return scene;
}

void placeCamera(const FrameOptions& options, scenes::Scene& scene) {
    if (!options.camera && options.pose == scenes::CameraChange()) return;
    const std::optional<std::string>& name = options.camera ? options.camera : scene.options.camera;
    scenes::Camera& camera = scene.cameras[name ? std::size_t(cameraNamed(scene, *name)) : 0];
    camera = scenes::changedCamera(camera, options.pose);
    scenes::aimDefaultLight(scene, camera);
}

Request resolveWithoutScene(const FrameOptions& options) {
    Request request;
    resolveOptions(options, request);
    return request;
}

void resolveForScene(const FrameOptions& options, Request& request) {
    resolveWishes(options, request);
}

Request resolve(const FrameOptions& options) {
    Request request = resolveWithoutScene(options);
    request.scene = loadFor(options, &request.files);
    resolveForScene(options, request);
    for (const std::string& warning : request.scene.warnings)
        spdlog::warn("{}", oneLine(request.scene.name + ": " + warning));
    return request;
}

recipes::Technique techniqueNamed(const std::string& name) {
    return rowNamed(recipes::techniqueTable(), name, "technique").technique;
}

glm::ivec2 sizeNamed(const std::string& text) {
    if (const std::optional<glm::ivec2> size = frame::sizeIn(text)) return *size;
    throw InputError(fmt::format("--size '{}' is not WIDTHxHEIGHT in pixels, each 1 to {}, as in 1280x720", text,
                                 frame::kLargestSidePixels));
}

} // namespace tessera::app
