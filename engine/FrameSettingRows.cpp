#include "engine/SettingRows.h"

#include <algorithm>

#include "engine/ChooseCulling.h"
#include "engine/ChooseLighting.h"
#include "engine/ChooseSamples.h"
#include "engine/ChooseView.h"
#include "engine/SettingValues.h"
#include "scenes/CameraNames.h"
#include "scenes/Limits.h"

namespace tessera::engine {

namespace {

using frame::AreaSettings, frame::FrameSettings;

int mostViewKey() {
    return std::ranges::max(frame::debugViewTable(), {}, &frame::DebugViewInfo::key).key;
}

/// Views can also be given by number.
SettingValue viewChoice() {
    SettingValue value = choice(in(&FrameSettings::view), frame::debugViewTable(), &frame::DebugViewInfo::view);
    std::vector<ChoiceKind::Entry>& entries = std::get<ChoiceKind>(value.kind).entries;
    for (std::size_t i = 0; i < entries.size(); ++i)
        if (const int key = frame::debugViewTable()[i].key; key > 0) entries[i].label += fmt::format("  ({})", key);
    value.read = [read = value.read](ViewRequest& request, const std::string& text, const TextSource& source) {
        for (const frame::DebugViewInfo& info : frame::debugViewTable())
            if (info.key != 0 && std::to_string(info.key) == text) return read(request, std::string(info.name), source);
        if (!text.empty() && text.find_first_not_of("0123456789") == std::string::npos)
            throw InputError(fmt::format("unknown view '{}': views are numbered 1 to {}", text, mostViewKey()));
        read(request, text, source);
    };
    return value;
}

int cameraNamed(const scenes::Scene& scene, const std::string& name) {
    if (const std::optional<std::size_t> camera = scenes::cameraCalled(scene, name)) return int(*camera);
    std::vector<std::string_view> names;
    for (const scenes::Camera& camera : scene.cameras) names.push_back(camera.name);
    throw InputError(fmt::format("{}: unknown camera '{}': {}", scene.name, name, suggestNames(name, names)));
}

SettingValue sceneCamera() {
    SettingValue value = valueIn(
        in(&FrameSettings::camera), CameraKind{}, [](int index) { return numberText(index); },
        [](const std::string&, const TextSource&) { return 0; });
    value.text = [](const ViewRequest& request, const scenes::Scene* scene) {
        const std::size_t index = std::size_t(request.settings.camera);
        if (scene == nullptr || index >= scene->cameras.size()) return numberText(request.settings.camera);
        return scenes::nameOfCamera(*scene, index);
    };
    value.read = [](ViewRequest& request, const std::string& text, const TextSource& source) {
        if (source.scene) request.settings.camera = cameraNamed(*source.scene, text);
    };
    return value;
}

SettingValue soloLight() {
    const auto valueOf = [](const std::string& text, const TextSource& source) {
        const double light = wholeNumber(text, source);
        const std::size_t count = source.scene ? source.scene->lights.size() : 0;
        if (source.scene && (light < 0.0 || light >= double(count)))
            throw InputError(fmt::format("{} {}: {} has {} light{}, counted from 0", source.called, light,
                                         source.scene->name, count, count == 1 ? "" : "s"));
        return int(std::clamp(light, -1.0, double(scenes::kMostLights))); // above the lights of any scene
    };
    return valueIn(
        in(&FrameSettings::soloLight), NumberKind{.least = 0.0, .isWhole = true},
        [](int light) { return numberText(light); }, valueOf, "all");
}

/// Names of all views, those of G-buffer channels as one pattern.
std::string viewNames() {
    std::string names;
    for (const frame::DebugViewInfo& info : frame::debugViewTable())
        if (!info.needsGBuffer) names += std::string(info.name) + ", ";
    return names + "or gbuffer.CHANNEL and gbuffer.CHANNEL.w as stored, CHANNEL one of " +
           namesOf(frame::channelTable());
}

bool hasGBuffer(Technique technique) {
    return infoOf(technique).usesGBuffer();
}
bool hasSeveralSamples(Technique technique) {
    return infoOf(technique).multisamples();
}
bool supportsItsMethod(const ViewRequest& request) {
    return supportsMethod(request.technique, request.settings.culling.method.value());
}
bool supportsItsSamples(const ViewRequest& request) {
    return supportsSamples(infoOf(request.technique), request.settings.samples);
}
bool supportsItsStage(const ViewRequest& request) {
    return infoOf(request.technique).choosesStage;
}
bool supportsItsView(const ViewRequest& request) {
    return supportsView(infoOf(request.technique), request.settings.view);
}

} // namespace

std::vector<Setting> frameSettings() {
    return {
        {.name = "technique",
         .flag = "--technique",
         .key = "technique",
         .type = "NAME",
         .help = "One of " + namesOf(techniqueTable()),
         .entersLight = false,
         .isRemembered = true,
         .value = choice(in(&ViewRequest::technique), techniqueTable(), &TechniqueInfo::technique)},
        {.name = "layout",
         .flag = "--layout",
         .key = "layout",
         .type = "NAME",
         .help = "G-buffer layout, one of " + namesOf(frame::layoutTable()),
         .label = "G-buffer",
         .usedBy = hasGBuffer,
         .entersLight = false,
         .isRemembered = true,
         .value = choice(in(&FrameSettings::layout), frame::layoutTable(), &frame::LayoutInfo::layout)},
        {.name = "culling",
         .flag = "--culling",
         .key = "culling",
         .type = "NAME",
         .help = "How lights are culled, one of " + namesOf(culling::methodTable()),
         .byItself = "the technique's own",
         .usedBy = hasLightLists,
         .supports = supportsItsMethod,
         .samePicture = true,
         .entersLight = false,
         .isRemembered = true,
         .value = choice(in(&culling::Settings::method), culling::methodTable(), &culling::MethodInfo::method)},
        {.name = "tile",
         .flag = "--tile",
         .key = "tile",
         .type = "PIXELS",
         .help = "Side of a light-culling tile",
         .byItself = numberText(culling::kUsualTilePixels),
         .usedBy = hasLightLists,
         .refusal = "it has no light lists",
         .samePicture = true,
         .entersLight = false,
         .isRemembered = true,
         .value = choice(in(&culling::Settings::tilePixels), culling::kTileSides, " pixels")},
        {.name = "cull-on",
         .flag = "--cull-on",
         .key = "cullOn",
         .type = "NAME",
         .help = "Who builds the light lists, one of " + namesOf(culling::builderTable()),
         .byItself = "cpu on software rasterisers, else compute",
         .label = "Build lists on",
         .usedBy = hasLightLists,
         .refusal = "it has no light lists",
         .samePicture = true,
         .entersLight = false,
         .value = choice(in(&culling::Settings::builder), culling::builderTable(), &culling::BuilderInfo::builder)},
        {.name = "cull-normals",
         .flag = "--cull-normals",
         .key = "cullNormals",
         .type = "NAME",
         .help = fmt::format("Whether light lists leave out lights behind every surface of their tile or cluster: {}; "
                             "where_worth is on for lists of {} lights or more. Only with --cull-on cpu",
                             namesOf(culling::normalTestTable()), culling::kLightsWorthNormals),
         .byItself = "where_worth",
         .label = "Normal culling",
         .usedBy = listsFromGBuffer,
         .refusal = "it does not build light lists from a G-buffer",
         .samePicture = true,
         .entersLight = false,
         .value = choice(in(&culling::Settings::normals), culling::normalTestTable(), &culling::NormalTestInfo::test)},
        {.name = "light-on",
         .flag = "--light-on",
         .key = "lightOn",
         .type = "NAME",
         .help = "Shader stage that lights the G-buffer, one of " + namesOf(frame::lightingStageTable()),
         .byItself = "fragment",
         .label = "Shade on",
         .usedBy = [](Technique technique) { return infoOf(technique).choosesStage; },
         .refusal = "it lights in fragment shaders only",
         .supports = supportsItsStage,
         .samePicture = true,
         .entersLight = false,
         .value = choice(in(&FrameSettings::lightOn), frame::lightingStageTable(), &frame::LightingStageInfo::stage)},
        {.name = "size",
         .flag = "--size",
         .key = "size",
         .type = "WxH",
         .help = "Picture size in pixels",
         .panel = SettingPanel::None,
         .sameCost = true,
         .entersLight = false,
         .value = pictureSize()},
        {.name = "samples",
         .flag = "--samples",
         .key = "samples",
         .type = "N",
         .help = "Samples of a pixel; more than 1 only with techniques without a G-buffer",
         .usedBy = hasSeveralSamples,
         .refusal = "it has a G-buffer",
         .supports = supportsItsSamples,
         .isRemembered = true,
         .value = choice(in(&FrameSettings::samples), frame::kSampleCounts)},
        {.name = "camera",
         .flag = "--camera",
         .key = "camera",
         .type = "NAME",
         .help = "A camera of the scene, by name or counted from 0",
         .byItself = "its first",
         .panel = SettingPanel::None,
         .sameCost = true,
         .entersLight = false,
         .isOfScene = true,
         .isShared = true,
         .value = sceneCamera()},
        {.name = "time",
         .flag = "--time",
         .key = "time",
         .type = "SECONDS",
         .help = "Time in seconds of lights that move, of the clip that plays and of the hook",
         .panel = SettingPanel::None,
         .sameCost = true,
         .isShared = true,
         .value = number(in(&FrameSettings::timeSeconds), {})},
        {.name = "range tolerance",
         .flag = "--range-tolerance",
         .key = "rangeTolerance",
         .type = "EPS",
         .help = "Irradiance at which lights of A B C falloff and area lights end; compare reports what that drops",
         .panel = SettingPanel::None,
         .value = number(in(&FrameSettings::rangeTolerance), {.least = 0.0})},
        {.name = "area lights",
         .flag = "--area-lights",
         .key = "areaLights",
         .type = "HOW",
         .help = "How the light of area lights on a surface is found: " + listed(frame::areaLightsTable()),
         .ofAreaLights = true,
         .value = choice(in(&AreaSettings::lights), frame::areaLightsTable(), &frame::AreaLightsInfo::lights)},
        {.name = "area samples",
         .flag = "--area-samples",
         .key = "areaSamples",
         .type = "N",
         .help = "With sampled: how many samples a pixel takes of each area light, by the light's surface, by the "
                 "diffuse part and by each highlight",
         .ofAreaLights = true,
         .ofAreaMethod = &frame::AreaLightsInfo::usesSamples,
         .value = choice(in(&AreaSettings::samples), frame::kAreaSamples)},
        {.name = "view",
         .flag = "--view",
         .key = "view",
         .type = "NAME",
         .help = fmt::format("What to show: 1 to {}, or one of {}", mostViewKey(), viewNames()),
         .panel = SettingPanel::View,
         .refusal = "it has no G-buffer",
         .supports = supportsItsView,
         .entersLight = false,
         .comesBack = false,
         .value = viewChoice()},
        {.name = "solo",
         .flag = "--solo",
         .key = "solo",
         .type = "N",
         .help = "Only this light shines, counted from 0; the environment is seen, but lights nothing",
         .panel = SettingPanel::None,
         .isOfScene = true,
         .isRequestable = false, // lights may be deleted
         .isShared = true,
         .value = soloLight()},
    };
}

std::vector<Setting> pictureSettings() {
    return {
        {.name = "specular",
         .flag = "--specular",
         .key = "specular",
         .type = "on|off",
         .help = "off leaves the specular lobe out",
         .entersLight = false,
         .value = onOff(&FrameSettings::specular)},
        {.name = "filter",
         .flag = "--filter",
         .key = "filter",
         .type = "NAME",
         .help = "Filters textures by hardware, or exact: level 0 alone, by the sampler's nearest or linear filter "
                 "in full precision",
         .panel = SettingPanel::None,
         .isOfFrame = true,
         .value = choice(in(&FrameSettings::filter), frame::textureFilterTable(), &frame::TextureFilterInfo::filter)},
        {.name = "space",
         .flag = "--space",
         .key = "space",
         .type = "NAME",
         .help = "Axes of lighting: world or view; the picture is the same",
         .panel = SettingPanel::None,
         .value = choice(in(&FrameSettings::space), frame::lightingSpaceTable(), &frame::LightingSpaceInfo::space)},
        {.name = "prune",
         .flag = "--prune",
         .key = "prune",
         .type = "on|off",
         .help = "Leaves out passes, buffers and shader code that the scene does not need; the picture is the same",
         .label = "Skip unused work",
         .isOfFrame = true,
         .value = onOff(&FrameSettings::prune)},
        {.name = "exposure",
         .flag = "--exposure",
         .key = "exposureEV",
         .type = "EV",
         .help = "Multiplies the display picture by 2^EV",
         .byItself = "estimated for models lit by their own lights alone, else 0",
         .group = "Display",
         .panel = SettingPanel::View,
         .sameCost = true,
         .entersLight = false,
         .isShared = true,
         .value = number(in(&FrameSettings::exposureEV), {.least = -frame::kMostExposureEV,
                                                          .most = frame::kMostExposureEV,
                                                          .sliderLeast = -10.0f,
                                                          .sliderMost = 10.0f,
                                                          .format = "%+.1f EV"})},
        {.name = "tone map",
         .flag = "--tonemap",
         .key = "toneMap",
         .type = "NAME",
         .help = "Tone map of display pictures, one of " + namesOf(frame::toneMapTable()),
         .byItself = "khronos_neutral for lit models, else none",
         .group = "Display",
         .panel = SettingPanel::View,
         .sameCost = true,
         .entersLight = false,
         .isShared = true,
         .isRemembered = true,
         .value = choice(in(&FrameSettings::toneMap), frame::toneMapTable(), &frame::ToneMapInfo::toneMap)},
    };
}

} // namespace tessera::engine
