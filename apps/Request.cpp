#include "apps/Request.h"

#include <cctype>
#include <charconv>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "base/Error.h"
#include "base/Names.h"
#include "base/OneLine.h"
#include "renderer/frame/MaterialFeatures.h"
#include "scenes/CameraNames.h"
#include "scenes/Clips.h"
#include "scenes/Defaults.h"
#include "scenes/InUse.h"
#include "scenes/Pose.h"
#include "scenes/RigLinks.h"
#include "validation/bench/MethodKey.h"

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

/// Parses a size such as 512M or 4G: a whole number of bytes, or of K, M, G = 2^10, 2^20, 2^30 bytes.
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

/// Names a setting by its command-line flag.
engine::TextSource fromCommandLine(const engine::Setting& setting, const scenes::Scene* scene = nullptr) {
    return {setting.flag, scene};
}

/// The time requested by the options, else by the scene.
double secondsFor(const FrameOptions& options, const scenes::Scene& scene) {
    const engine::Setting& time = engine::settingOf("time");
    engine::ViewRequest request;
    if (const auto said = options.said("time"))
        time.read(request, *said, fromCommandLine(time));
    else
        engine::applyRequestedOptions(scene, options.scene, request, [](const engine::Setting& setting) {
            return setting.key != "time"; // the other settings are only checked, not applied
        });
    return request.settings.timeSeconds;
}

} // namespace

std::optional<std::string> FrameOptions::said(std::string_view key) const {
    const auto found = settings.find(key);
    return found == settings.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::string> contextNames() {
    std::vector<std::string> names;
    for (const NamedContext& context : kContexts) names.emplace_back(context.name);
    return names;
}

gpu::ContextKind contextKind(const std::string& name) {
    return rowNamed(kContexts, name, "context").kind;
}

scenes::LightUnits lightUnitsNamed(const std::string& name) {
    return rowNamed(scenes::kLightUnits, name, "unit of light").units;
}

scenes::ObjColours objColoursNamed(const std::string& name) {
    return rowNamed(scenes::kObjColours, name, "encoding of colours").encoding;
}

std::string camerasText(const FrameOptions& options, const Request& request) {
    const auto camera = std::size_t(request.settings.camera);
    const std::string others = scenes::otherCamerasText(request.scene, camera);
    if (others.empty() || options.said("camera") || options.pose.eyeWS) return "";
    return oneLine(fmt::format("camera '{}' of {}; --camera takes {}", scenes::nameOfCamera(request.scene, camera),
                               request.scene.cameras.size(), others));
}

scenes::LoadOptions loadOptionsOf(const FrameOptions& options) {
    scenes::LoadOptions load;
    load.lights = options.lights;
    load.defaultLight = !options.noDefaultLight;
    load.defaultCamera = options.defaultCamera;
    load.environment = options.environment;
    load.background = options.background;
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

scenes::Scene loadFor(const FrameOptions& options, std::vector<std::string>* files, std::stop_token stop) {
    scenes::LoadOptions load = loadOptionsOf(options);
    load.files = files;
    load.stop = std::move(stop);
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
    const scenes::Camera before = camera;
    camera = scenes::changedCamera(camera, options.pose);
    scenes::ownCamera(scene, std::size_t(request.settings.camera), before);
}

Request resolveWithoutScene(const FrameOptions& options) {
    Request request;
    for (const engine::Setting& setting : engine::settingTable())
        if (const auto text = options.said(setting.key)) setting.read(request, *text, fromCommandLine(setting));
    if (options.memoryLimit) bytesNamed(*options.memoryLimit);
    if (options.defaultCamera && options.said("camera"))
        throw InputError("--camera chooses one of the scene's cameras, whose place --default-camera takes; give one of "
                         "the two");
    return request;
}

void resolveForScene(const FrameOptions& options, Request& request) {
    const auto isSaid = [&](const engine::Setting& setting) { return options.said(setting.key).has_value(); };
    engine::applyRequestedOptions(request.scene, options.scene, request, isSaid);
    for (const engine::Setting& setting : engine::settingTable())
        if (const auto text = setting.isOfScene ? options.said(setting.key) : std::nullopt)
            setting.read(request, *text, fromCommandLine(setting, &request.scene));
}

void warnOfScene(const scenes::Scene& scene) {
    for (const std::string& warning : scene.warnings) spdlog::warn("{}", oneLine(scene.name + ": " + warning));
    if (const std::string clip = scenes::clipText(scene); !clip.empty())
        spdlog::info("{}", oneLine(scene.name + ": " + clip));
    if (const std::string supplied = scenes::suppliedText(scene); !supplied.empty())
        spdlog::info("{}", oneLine(scene.name + ": " + supplied));
    for (const std::string& note : scene.notes) spdlog::info("{}", oneLine(scene.name + ": " + note));
}

Request resolve(const FrameOptions& options, std::stop_token stop) {
    Request request = resolveWithoutScene(options);
    request.scene = loadFor(options, &request.files, std::move(stop));
    resolveForScene(options, request);
    warnOfScene(request.scene);
    return request;
}

namespace {

/// Why a given subsurface setting changes nothing. `--subsurface none` is never reported: every scene can do without.
std::string whyNoScattering(const engine::Setting& setting, const Request& request) {
    if (setting.key == "subsurface" && request.settings.subsurface == scenes::SubsurfaceMethod::None) return {};
    if (!scenes::anyScatters(request.scene))
        return "No material has subsurface scattering; give one the key 'subsurface' in a scene file";
    if (setting.key == "subsurface" || scenes::anyDiffuses(request.scene, request.settings.subsurface)) return {};
    constexpr auto kDiffusion = scenes::SubsurfaceMethod::TextureSpaceDiffusion;
    if (!scenes::anyDiffuses(request.scene, kDiffusion)) return "No surface that is drawn has subsurface scattering";
    return fmt::format("No surface diffuses light; give --subsurface {}", infoOf(kDiffusion).name);
}

/// Why a given shadow setting changes nothing although the view has shadows.
std::string whyNoPartOfShadows(const engine::Setting& setting, const Request& request,
                               const frame::PreparedView& prepared) {
    if (std::string why = setting.whyIdle(request); !why.empty()) return why;
    const auto rows = infoOf(validation::MethodKind::Shadows).settings;
    const auto row = std::ranges::find(rows, setting.key, &validation::MethodSetting::key);
    const bool matters = row == rows.end() || row->matters({request.scene, request.settings, prepared});
    return matters ? "" : std::string(row->absent);
}

std::string whyNoShadows(const engine::Setting& setting, const Request& request, const frame::PreparedView& prepared) {
    if (setting.key == "shadows") return {};
    if (prepared.lights.shadowed > 0) return whyNoPartOfShadows(setting, request, prepared);
    return "There are no shadows: " + frame::whyNoShadows(request.scene, prepared.lights, request.settings.shadows);
}

/// Warning for a given soft shadow filter in a view without shadowed area lights.
std::string asHardShadows(const engine::Setting& setting, const Request& request, const frame::PreparedView& prepared) {
    const frame::ShadowFilterInfo& filter = infoOf(request.settings.shadowFilter);
    if (setting.key != "shadowFilter" || !filter.usesMaps || !filter.usesSizes || prepared.lights.shadowed == 0 ||
        prepared.lights.features[frame::Feature::SoftShadows])
        return {};
    return fmt::format("{} {} looks up one texel, as {} does: no light in view that casts shadows has a size",
                       setting.flag, filter.name, infoOf(frame::ShadowFilter::Hard).name);
}

} // namespace

std::string whyUnused(const engine::Setting& setting, const Request& request) {
    const bool isOfGlass = setting.key == "refraction" || setting.key == "glassDepth";
    if (isOfGlass && !frame::mayLookBehindGlass(request.scene))
        return "No material that transmits has a thickness or is rough";
    return setting.whyIdle(request, &request.scene);
}

std::string unusedText(const engine::Setting& setting, std::string why) {
    why.front() = char(std::toupper(static_cast<unsigned char>(why.front())));
    return fmt::format("{} changes nothing. {}", setting.flag, why);
}

std::vector<std::string> unusedSettings(const FrameOptions& options, const Request& request,
                                        const frame::PreparedView& prepared,
                                        std::span<const engine::Technique> techniques, bool besideReference) {
    std::vector<std::string> messages;
    if (!frame::showsShadows(request.settings.view)) return messages; // the same options serve all views
    for (const engine::Setting& setting : engine::settingTable()) {
        if (!options.said(setting.key)) continue;
        std::string why = setting.whyIgnored(request, techniques);
        if (setting.ofReference && !besideReference && !setting.isDefault(request))
            why = "The reference alone uses it; draw by --technique reference, or compare with it";
        else if (setting.panel == engine::SettingPanel::Skin)
            why = whyNoScattering(setting, request);
        else if (setting.panel == engine::SettingPanel::Shadows)
            why = whyNoShadows(setting, request, prepared);
        else if (why.empty())
            why = whyUnused(setting, request);
        if (const std::string asHard = asHardShadows(setting, request, prepared); !asHard.empty())
            messages.push_back(asHard);
        else if (!why.empty())
            messages.push_back(unusedText(setting, why));
    }
    const bool isBehindMap = request.scene.environment && request.settings.environment.backdrop != frame::Backdrop::Off;
    if (options.background && isBehindMap)
        messages.emplace_back("--background changes nothing. The environment is seen behind the scene; give --backdrop "
                              "off, or --environment none");
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
