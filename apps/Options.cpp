#include "apps/Options.h"

#include <charconv>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "scenes/Error.h"
#include "scenes/Names.h"

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

struct NamedFilter {
    std::string_view name;
    frame::TextureFilter filter;
};
constexpr NamedFilter kFilters[] = {{"hardware", frame::TextureFilter::Hardware},
                                    {"exact", frame::TextureFilter::Exact}};

struct NamedSpace {
    std::string_view name;
    frame::LightingSpace space;
};
constexpr NamedSpace kSpaces[] = {{"world", frame::LightingSpace::World}, {"view", frame::LightingSpace::View}};

struct NamedContext {
    std::string_view name;
    gpu::ContextKind kind;
};
constexpr NamedContext kContexts[] = {
    {"auto", gpu::ContextKind::Auto}, {"window", gpu::ContextKind::Window}, {"egl", gpu::ContextKind::Egl}};

int cameraNamed(const scenes::Scene& scene, const std::string& name) {
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        if (scene.cameras[i].name == name) return int(i);
        names.push_back(scene.cameras[i].name);
    }
    throw InputError(fmt::format("{}: unknown camera '{}': {}", scene.name, name, suggestNames(name, names)));
}

frame::View viewNamed(const std::string& name) {
    for (const frame::ViewInfo& info : frame::viewTable()) {
        if (info.key != 0 && std::to_string(info.key) == name) return info.view;
    }
    return rowNamed(frame::viewTable(), name, "view").view;
}

/// The user's word, else the scene's, else none.
const std::optional<std::string>& firstOf(const std::optional<std::string>& user,
                                          const std::optional<std::string>& scene) {
    return user ? user : scene;
}

void resolveSettings(const FrameOptions& options, Request& request) {
    const scenes::SceneOptions& wish = request.scene.options;
    frame::FrameSettings& settings = request.settings;
    if (const auto& name = firstOf(options.technique, wish.technique)) request.technique = techniqueNamed(*name);
    request.layoutName = firstOf(options.layout, wish.layout).value_or(std::string(frame::layoutTable()[0].name));
    settings.layout = rowNamed(frame::layoutTable(), request.layoutName, "layout").layout;
    if (const auto& name = firstOf(options.camera, wish.camera)) settings.camera = cameraNamed(request.scene, *name);
    if (const auto& name = firstOf(options.toneMap, wish.toneMap)) {
        settings.toneMap = rowNamed(frame::toneMapTable(), *name, "tone map").toneMap;
    }
    if (options.size)
        settings.sizePixels = sizeNamed(*options.size);
    else if (wish.sizePixels)
        settings.sizePixels = *wish.sizePixels;
    settings.exposureEV = options.exposureEV ? *options.exposureEV : wish.exposureEV.value_or(0.0f);
    if (options.view) settings.view = viewNamed(*options.view);
    if (options.filter) settings.filter = rowNamed(kFilters, *options.filter, "filter").filter;
    if (options.space) settings.space = rowNamed(kSpaces, *options.space, "space").space;
    if (options.prune) settings.prune = rowNamed(kSwitch, *options.prune, "prune value").on;
    if (options.specular) settings.specular = rowNamed(kSwitch, *options.specular, "specular value").on;
    settings.timeSeconds = options.timeSeconds.value_or(0.0);
    settings.soloLight = options.solo;
}

} // namespace

void addGlobalOptions(CLI::App& app, GlobalOptions& options) {
    app.add_flag("--quiet", options.quiet, "Errors only: no warnings, no progress");
    app.add_flag("--verbose", options.verbose, "More detail; with --version the OpenGL strings");
    app.add_option("--context", options.context,
                   "auto, window or egl: where pictures are made. auto takes EGL, which needs no display")
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
    CLI::Option* scene = command.add_option("scene", options.scene,
                                            "A .gltf, .glb, .obj or .json file, or a built-in scene (tessera scenes)");
    scene->type_name("SCENE");
    if (defaultScene.empty()) scene->required();
    const auto text = [&](const char* flag, std::optional<std::string>& target, const std::string& help,
                          const char* type) {
        command.add_option(flag, target, help)->type_name(type)->group("Frame");
    };
    text("--technique", options.technique, "One of: " + namesOf(recipes::techniqueTable()) + " [deferred]", "NAME");
    text("--layout", options.layout, "G-buffer layout, one of: " + namesOf(frame::layoutTable()) + " [exact]", "NAME");
    text("--size", options.size, "Picture size in pixels [1280x720]", "WxH");
    text("--camera", options.camera, "A camera of the scene [its first]", "NAME");
    command.add_option("--time", options.timeSeconds, "Moves animated lights to this time [0]")
        ->type_name("SECONDS")
        ->group("Frame");
    command.add_option("--lights", options.lights, "Built-in scenes make this many lights, files keep their first N")
        ->type_name("N")
        ->group("Frame");
    text("--view", options.view, "What to show: 1 to 7 or one of: " + namesOf(frame::viewTable()) + " [final]", "NAME");
    command.add_option("--solo", options.solo, "Only this light shines, counted from 0")
        ->type_name("N")
        ->group("Frame");
    text("--specular", options.specular, "on or off: leaves the specular lobe out", "SWITCH");
    text("--filter", options.filter, "Textures by hardware, or exact: bilinear in fp32 at level 0 [hardware]", "NAME");
    text("--space", options.space, "Lighting in world or view space; the pictures agree [world]", "NAME");
    text("--prune", options.prune, "on, or off: keeps what the scene does not need; the picture is the same", "SWITCH");
    command.add_flag("--no-default-light", options.noDefaultLight, "Leaves a scene without lights dark")
        ->group("Frame");
    command.add_option("--exposure", options.exposureEV, "Multiplies the display picture by 2^EV [0]")
        ->type_name("EV")
        ->group("Display");
    command.add_option("--tonemap", options.toneMap, "One of: " + namesOf(frame::toneMapTable()) + " [none]")
        ->type_name("NAME")
        ->group("Display");
}

Request resolve(const FrameOptions& options) {
    Request request;
    // Names are checked before a large scene is read for nothing.
    if (options.technique) techniqueNamed(*options.technique);
    if (options.layout) rowNamed(frame::layoutTable(), *options.layout, "layout");
    if (options.view) viewNamed(*options.view);
    if (options.size) sizeNamed(*options.size);
    scenes::LoadOptions load;
    load.lights = options.lights;
    load.defaultLight = !options.noDefaultLight;
    request.scene = scenes::loadScene(options.scene, load);
    for (const std::string& warning : request.scene.warnings) spdlog::warn("{}: {}", request.scene.name, warning);
    resolveSettings(options, request);
    return request;
}

recipes::Technique techniqueNamed(const std::string& name) {
    return rowNamed(recipes::techniqueTable(), name, "technique").technique;
}

glm::ivec2 sizeNamed(const std::string& text) {
    constexpr int kLargestSide = 16384;
    glm::ivec2 size(0);
    const char* end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.x);
    const bool hasCross = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
    const auto height = hasCross ? std::from_chars(width.ptr + 1, end, size.y) : width;
    const bool good = hasCross && height.ec == std::errc() && height.ptr == end;
    if (!good || size.x < 1 || size.y < 1 || size.x > kLargestSide || size.y > kLargestSide) {
        throw InputError(
            fmt::format("--size '{}' is not WIDTHxHEIGHT in pixels, each 1 to {}, as in 1280x720", text, kLargestSide));
    }
    return size;
}

} // namespace tessera::app
