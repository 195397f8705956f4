#include "apps/Options.h"

#include <cctype>
#include <charconv>
#include <limits>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/Numbers.h"
#include "base/Error.h"
#include "base/Names.h"
#include "base/OneLine.h"
#include "scenes/Pose.h"
#include "validation/bench/ShadowKey.h"

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

struct NamedContext {
    std::string_view name;
    gpu::ContextKind kind;
};
constexpr NamedContext kContexts[] = {
    {"auto", gpu::ContextKind::Auto}, {"window", gpu::ContextKind::Window}, {"egl", gpu::ContextKind::Egl}};

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

/// As the command line calls a setting.
engine::TextSource fromCommandLine(const engine::Setting& setting, const scenes::Scene* scene = nullptr) {
    return {setting.flag, scene};
}

/// "none, studio (what it is for), ..."
std::string environmentNames() {
    std::string names(scenes::kNoEnvironment);
    for (const scenes::BuiltinEnvironment& builtin : scenes::builtinEnvironments())
        names += fmt::format(", {} ({})", builtin.name, builtin.purpose);
    return names;
}

void addSettings(CLI::App& command, FrameOptions& options, std::string_view group) {
    for (const engine::Setting& setting : engine::settingTable()) {
        if (setting.group != group) continue;
        const std::string byItself =
            setting.byItself.empty() ? setting.text(engine::ViewRequest()) : std::string(setting.byItself);
        const std::string range = setting.range().empty() ? "" : fmt::format(" ({})", setting.range());
        const auto say = [&options, &setting](const std::string& text) {
            options.settings.insert_or_assign(std::string(setting.key), text);
        };
        command
            .add_option_function<std::string>(std::string(setting.flag), say,
                                              fmt::format("{}{} [{}]", setting.help, range, byItself))
            ->type_name(std::string(setting.type))
            ->group(std::string(group));
        if (setting.key == "time") // beside the other options of lights
            addWholeNumber(command, "--lights", options.lights,
                           "Built-in scenes make this many lights, files keep their first N", "N")
                ->group(std::string(group));
        if (setting.key == "time")
            command
                .add_option("--clip", options.clip,
                            "The clip of the scene that plays, by name or counted from 0, or none [its first]")
                ->type_name("NAME")
                ->group(std::string(group));
        if (setting.key == "time")
            addHookValues(command, "--hook", options.hookValues,
                          "Sets a parameter of the scene's hook, within its bounds; may be repeated", "NAME=VALUE")
                ->group(std::string(group));
    }
}

/// The time that the options, else the scene ask for.
double secondsFor(const FrameOptions& options, const scenes::Scene& scene) {
    const engine::Setting& time = engine::settingOf("time");
    engine::ViewRequest request;
    if (const auto said = options.said("time"))
        time.read(request, *said, fromCommandLine(time));
    else
        engine::takeWishes(scene, options.scene, request, [](const engine::Setting& setting) {
            return setting.key != "time"; // of the others the texts alone are read
        });
    return request.settings.timeSeconds;
}

} // namespace

std::optional<std::string> FrameOptions::said(std::string_view key) const {
    const auto found = settings.find(key);
    return found == settings.end() ? std::nullopt : std::optional(found->second);
}

void addGlobalOptions(CLI::App& app, GlobalOptions& options) {
    app.add_flag("--quiet", options.quiet, "Errors only: no warnings, no progress");
    app.add_flag("--verbose", options.verbose, "More detail; with --version the driver's limits too");
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

std::vector<std::string> contextNames() {
    std::vector<std::string> names;
    for (const NamedContext& context : kContexts) names.emplace_back(context.name);
    return names;
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
    addSettings(command, options, "Frame");
    command.add_flag("--no-default-light", options.noDefaultLight, "Leaves a scene without lights dark")
        ->group("Frame");
    command
        .add_option("--environment", options.environment,
                    "Lights the scene from everywhere: " + environmentNames() +
                        " or a picture in latitude and "
                        "longitude [the scene's own]")
        ->type_name("NAME")
        ->group("Environment");
    addSettings(command, options, "Environment");
    addSettings(command, options, "Shadows");
    addSettings(command, options, "Subsurface scattering");
    command
        .add_option("--memory-limit", options.memoryLimit,
                    "The most memory that reading a scene may take [half of the machine's]")
        ->type_name("SIZE")
        ->group("Reading");
    command
        .add_option("--variant", options.import.variant,
                    "Shows the models in this variant of their materials; a name that none has is refused with a list "
                    "of those there are [the materials without a variant]")
        ->type_name("NAME")
        ->group("Reading");
    command
        .add_option_function<std::string>(
            "--light-units",
            [&options](const std::string& name) {
                options.import.lightUnits = rowNamed(scenes::kLightUnits, name, "unit of light").units;
            },
            "What the numbers of a glTF model's lights count: lumen, 683 for each watt, or watt [lumen for models that "
            "Blender exported, else watt]")
        ->type_name("NAME")
        ->group("Reading");
    command
        .add_flag("--strict", options.import.isStrict,
                  "Refuses a model of which a picture cannot be read; else a checkerboard is drawn for its colours")
        ->group("Reading");
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
    addSettings(command, options, "Display");
}

scenes::LoadOptions loadOptionsOf(const FrameOptions& options) {
    scenes::LoadOptions load;
    load.lights = options.lights;
    load.defaultLight = !options.noDefaultLight;
    load.environment = options.environment;
    load.clip = options.clip;
    load.hookValues = options.hookValues;
    load.import = options.import;
    if (const auto size = options.said("size")) {
        const glm::dvec2 pixels = sizeNamed(std::string(engine::settingOf("size").flag), *size);
        load.aspect = pixels.x / pixels.y;
    }
    if (options.memoryLimit) load.memoryLimitBytes = bytesNamed(*options.memoryLimit);
    return load;
}

void poseAt(scenes::Scene& scene, double timeSeconds, const std::string& file) {
    try {
        scenes::poseScene(scene, timeSeconds);
    } catch (const InputError& error) {
        throw InputError(
            fmt::format("{}: at {:g} s of {}: {}", file, timeSeconds, scenes::clipText(scene), error.what()));
    }
}

scenes::Scene loadFor(const FrameOptions& options, std::vector<std::string>* files) {
    scenes::LoadOptions load = loadOptionsOf(options);
    load.files = files;
    scenes::Scene scene = scenes::loadScene(options.scene, load);
    if (scenes::isPlaying(scene)) poseAt(scene, secondsFor(options, scene), options.scene);
    placeCamera(options, scene);
    return scene;
}

void placeCamera(const FrameOptions& options, scenes::Scene& scene) {
    const std::optional<std::string> said = options.said("camera");
    if (!said && options.pose == scenes::CameraChange()) return;
    const std::optional<std::string>& name = said ? said : scene.options.camera;
    engine::ViewRequest request;
    if (name) engine::settingOf("camera").read(request, *name, {{}, &scene});
    scenes::Camera& camera = scene.cameras[std::size_t(request.settings.camera)];
    const glm::dmat4 before = camera.worldFromCamera;
    camera = scenes::changedCamera(camera, options.pose);
    if (camera.worldFromCamera != before)
        std::erase_if(scene.rig.cameras,
                      [&](const scenes::Carried& carried) { return carried.element == request.settings.camera; });
}

Request resolveWithoutScene(const FrameOptions& options) {
    Request request;
    for (const engine::Setting& setting : engine::settingTable())
        if (const auto text = options.said(setting.key)) setting.read(request, *text, fromCommandLine(setting));
    if (options.memoryLimit) bytesNamed(*options.memoryLimit);
    return request;
}

void resolveForScene(const FrameOptions& options, Request& request) {
    const auto isSaid = [&](const engine::Setting& setting) { return options.said(setting.key).has_value(); };
    engine::takeWishes(request.scene, options.scene, request, isSaid);
    for (const engine::Setting& setting : engine::settingTable())
        if (const auto text = setting.isOfScene ? options.said(setting.key) : std::nullopt)
            setting.read(request, *text, fromCommandLine(setting, &request.scene));
}

Request resolve(const FrameOptions& options) {
    Request request = resolveWithoutScene(options);
    request.scene = loadFor(options, &request.files);
    resolveForScene(options, request);
    for (const std::string& warning : request.scene.warnings)
        spdlog::warn("{}", oneLine(request.scene.name + ": " + warning));
    if (const std::string clip = scenes::clipText(request.scene); !clip.empty())
        spdlog::info("{}", oneLine(request.scene.name + ": " + clip));
    for (const std::string& note : request.scene.notes) spdlog::info("{}", oneLine(request.scene.name + ": " + note));
    return request;
}

std::vector<std::string> unheededShadows(const FrameOptions& options, const Request& request,
                                         const frame::PreparedView& prepared) {
    std::vector<std::string> messages;
    if (!frame::showsShadows(request.settings.view)) return messages; // the same options serve all views
    for (const engine::Setting& setting : engine::settingTable()) {
        if (setting.panel != engine::SettingPanel::Shadows || setting.key == "shadows" || !options.said(setting.key))
            continue;
        const frame::ShadowFilterInfo& filter = infoOf(request.settings.shadowFilter);
        if (setting.key == "shadowFilter" && filter.usesMaps && filter.heedsSizes && prepared.lights.shadowed > 0 &&
            !prepared.lights.features[frame::Feature::SoftShadows]) {
            messages.push_back(fmt::format("{} {} looks up one texel, as {} does: no light in view that casts shadows "
                                           "has a size",
                                           setting.flag, filter.name, infoOf(frame::ShadowFilter::Hard).name));
            continue;
        }
        std::string why = setting.whyIdle(request);
        const auto rows = validation::shadowSettingTable();
        const auto row = std::ranges::find(rows, setting.key, &validation::ShadowSetting::key);
        if (prepared.lights.shadowed == 0)
            why = "There are no shadows: " +
                  frame::whyNoShadows(request.scene, prepared.lights, request.settings.shadows);
        else if (why.empty() && row != rows.end() && !row->matters(prepared.lights, request.settings.shadowFilter))
            why = std::string(row->absent);
        if (why.empty()) continue;
        why.front() = char(std::toupper(static_cast<unsigned char>(why.front())));
        messages.push_back(fmt::format("{} changes nothing. {}", setting.flag, why));
    }
    return messages;
}

engine::Technique techniqueNamed(const std::string& name) {
    engine::ViewRequest request;
    engine::settingOf("technique").read(request, name);
    return request.technique;
}

glm::ivec2 sizeNamed(const std::string& flag, const std::string& text) {
    engine::ViewRequest request;
    engine::settingOf("size").read(request, text, {flag, nullptr});
    return request.settings.sizePixels;
}

} // namespace tessera::app
