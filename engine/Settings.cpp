#include "engine/Settings.h"

#include <algorithm>
#include <cassert>
#include <cctype>

#include "engine/ChooseCulling.h"
#include "engine/ChooseLighting.h"
#include "engine/ChooseSamples.h"
#include "engine/ChooseView.h"
#include "engine/SettingValues.h"
#include "scenes/Limits.h"

namespace tessera::engine {

namespace {

using frame::DiffusionSettings, frame::EnvironmentSettings, frame::FrameSettings, frame::ShadowMapSettings;

// ---- Settings that are more than a value of a kind -----------------------------------------------------------------

int mostViewKey() {
    return std::ranges::max(frame::debugViewTable(), {}, &frame::DebugViewInfo::key).key;
}

/// Views also go by their numbers.
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
        const std::string& name = scene->cameras[index].name;
        const bool isCalledSo = !name.empty() && scenes::cameraCalled(*scene, name) == index;
        return isCalledSo ? name : numberText(request.settings.camera);
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
        return int(std::clamp(light, -1.0, double(scenes::kMostLights))); // which no scene has
    };
    return valueIn(
        in(&FrameSettings::soloLight), NumberKind{.least = 0.0, .isWhole = true},
        [](int light) { return numberText(light); }, valueOf, "all");
}

struct ShadowChoice {
    scenes::ShadowRequest request;
    std::string_view name, summary;
};
constexpr ShadowChoice kShadowChoices[] = {
    {{scenes::ShadowRequest::Kind::None}, "none", "no light casts shadows"},
    {{scenes::ShadowRequest::Kind::Asked}, "asked", "lights with castsShadow cast shadows"},
    {{scenes::ShadowRequest::Kind::All}, "all", "every light casts shadows"},
};

SettingValue shadowChoice() {
    ChoiceKind kind;
    std::vector<std::string_view> names;
    for (const ShadowChoice& row : kShadowChoices) {
        kind.entries.push_back({std::string(row.name), std::string(row.name), row.summary});
        names.push_back(row.name);
    }
    kind.orCount = true;
    const auto textOf = [](const scenes::ShadowRequest& request) {
        const auto* const row = std::ranges::find(kShadowChoices, request, &ShadowChoice::request);
        return row == std::end(kShadowChoices) ? numberText(request.lights) : std::string(row->name);
    };
    const auto valueOf = [names](const std::string& text, const TextSource& source) {
        for (const ShadowChoice& row : kShadowChoices)
            if (row.name == text) return row.request;
        const std::optional<double> lights = wholeNumberIn(text);
        if (!lights) {
            const bool isNear = !nearestNames(text, names).empty();
            throw InputError(fmt::format("unknown {} '{}': give {} or a number N, for the first N lights{}",
                                         source.called, text, fmt::join(names, ", "),
                                         isNear ? "; " + suggestNames(text, names) : ""));
        }
        requireBounds({.least = 0.0, .isWhole = true}, *lights, source);
        return scenes::ShadowRequest{scenes::ShadowRequest::Kind::First, int(*lights)};
    };
    return valueIn(in(&FrameSettings::shadows), std::move(kind), textOf, valueOf);
}

template <typename Row>
std::string namesOf(std::span<const Row> table) {
    std::string names;
    for (const Row& row : table) names += (names.empty() ? "" : ", ") + std::string(row.name);
    return names;
}

/// "none (what it does), ..."
template <typename Row>
std::string listed(std::span<const Row> table) {
    std::string text;
    for (const Row& row : table) text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", row.name, row.summary);
    return text;
}

/// Those of the G-buffer's channels as one pattern.
std::string viewNames() {
    std::string names;
    for (const frame::DebugViewInfo& info : frame::debugViewTable())
        if (!info.needsGBuffer) names += std::string(info.name) + ", ";
    return names + "or gbuffer.CHANNEL and gbuffer.CHANNEL.w as stored, CHANNEL one of " +
           namesOf(frame::channelTable());
}

// ---- The table -----------------------------------------------------------------------------------------------------

bool hasGBuffer(Technique technique) {
    return infoOf(technique).usesGBuffer();
}
bool hasSeveralSamples(Technique technique) {
    return infoOf(technique).multisamples();
}
bool takesItsMethod(const ViewRequest& request) {
    return takesMethod(request.technique, request.settings.culling.method.value());
}
bool takesItsSamples(const ViewRequest& request) {
    return takesSamples(infoOf(request.technique), request.settings.samples);
}
bool takesItsStage(const ViewRequest& request) {
    return infoOf(request.technique).choosesStage;
}
bool takesItsView(const ViewRequest& request) {
    return takesView(infoOf(request.technique), request.settings.view);
}

std::vector<Setting> makeTable() {
    return {
        {.name = "technique",
         .flag = "--technique",
         .key = "technique",
         .type = "NAME",
         .help = "One of " + namesOf(techniqueTable()),
         .isRemembered = true,
         .value = choice(in(&ViewRequest::technique), techniqueTable(), &TechniqueInfo::technique)},
        {.name = "layout",
         .flag = "--layout",
         .key = "layout",
         .type = "NAME",
         .help = "G-buffer layout, one of " + namesOf(frame::layoutTable()),
         .label = "G-buffer",
         .heeds = hasGBuffer,
         .isRemembered = true,
         .value = choice(in(&FrameSettings::layout), frame::layoutTable(), &frame::LayoutInfo::layout)},
        {.name = "culling",
         .flag = "--culling",
         .key = "culling",
         .type = "NAME",
         .help = "How lights are culled, one of " + namesOf(culling::methodTable()),
         .byItself = "the technique's own",
         .heeds = hasLightLists,
         .takes = takesItsMethod,
         .samePicture = true,
         .isRemembered = true,
         .value = choice(in(&culling::Settings::method), culling::methodTable(), &culling::MethodInfo::method)},
        {.name = "tile",
         .flag = "--tile",
         .key = "tile",
         .type = "PIXELS",
         .help = "Side of a light-culling tile",
         .byItself = numberText(culling::kUsualTilePixels),
         .heeds = hasLightLists,
         .refusal = "it has no light lists",
         .samePicture = true,
         .isRemembered = true,
         .value = choice(in(&culling::Settings::tilePixels), culling::kTileSides, " pixels")},
        {.name = "cull-on",
         .flag = "--cull-on",
         .key = "cullOn",
         .type = "NAME",
         .help = "Who builds the light lists, one of " + namesOf(culling::builderTable()),
         .byItself = "by backend",
         .label = "Lists built by",
         .heeds = hasLightLists,
         .refusal = "it has no light lists",
         .samePicture = true,
         .value = choice(in(&culling::Settings::builder), culling::builderTable(), &culling::BuilderInfo::builder)},
        {.name = "cull-normals",
         .flag = "--cull-normals",
         .key = "cullNormals",
         .type = "NAME",
         .help = fmt::format("Whether light lists leave out lights behind all surfaces that they are for: {}; "
                             "where_worth is on for lists of {} lights or more. Only with --cull-on cpu",
                             namesOf(culling::normalTestTable()), culling::kLightsWorthNormals),
         .byItself = "where_worth",
         .label = "By normals",
         .heeds = listsFromGBuffer,
         .refusal = "it does not build light lists from a G-buffer",
         .samePicture = true,
         .value = choice(in(&culling::Settings::normals), culling::normalTestTable(), &culling::NormalTestInfo::test)},
        {.name = "light-on",
         .flag = "--light-on",
         .key = "lightOn",
         .type = "NAME",
         .help = "What lights the G-buffer, one of " + namesOf(frame::lightingStageTable()),
         .byItself = "fragment",
         .label = "Light on",
         .heeds = [](Technique technique) { return infoOf(technique).choosesStage; },
         .refusal = "it lights in fragment shaders only",
         .takes = takesItsStage,
         .samePicture = true,
         .value = choice(in(&FrameSettings::lightOn), frame::lightingStageTable(), &frame::LightingStageInfo::stage)},
        {.name = "size",
         .flag = "--size",
         .key = "size",
         .type = "WxH",
         .help = "Picture size in pixels",
         .panel = SettingPanel::None,
         .sameCost = true,
         .value = pictureSize()},
        {.name = "samples",
         .flag = "--samples",
         .key = "samples",
         .type = "N",
         .help = "Samples of a pixel; more than 1 without a G-buffer only",
         .heeds = hasSeveralSamples,
         .refusal = "it has a G-buffer",
         .takes = takesItsSamples,
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
         .isOfScene = true,
         .isShared = true,
         .value = sceneCamera()},
        {.name = "time",
         .flag = "--time",
         .key = "time",
         .type = "SECONDS",
         .help = "Moves animated lights to this time",
         .panel = SettingPanel::None,
         .sameCost = true,
         .isShared = true,
         .value = number(in(&FrameSettings::timeSeconds), {})},
        {.name = "range tolerance",
         .flag = "--range-tolerance",
         .key = "rangeTolerance",
         .type = "EPS",
         .help = "Ends lights of A B C falloff where they fall to this; compare tells what it drops",
         .panel = SettingPanel::None,
         .value = number(in(&FrameSettings::rangeTolerance), {.least = 0.0})},
        {.name = "view",
         .flag = "--view",
         .key = "view",
         .type = "NAME",
         .help = fmt::format("What to show: 1 to {}, or one of {}", mostViewKey(), viewNames()),
         .panel = SettingPanel::View,
         .refusal = "it has no G-buffer",
         .takes = takesItsView,
         .comesBack = false,
         .value = viewChoice()},
        {.name = "solo",
         .flag = "--solo",
         .key = "solo",
         .type = "N",
         .help = "Only this light shines, counted from 0",
         .panel = SettingPanel::None,
         .isOfScene = true,
         .isWishable = false, // lights may be deleted
         .isShared = true,
         .value = soloLight()},
        {.name = "environment light",
         .flag = "--environment-light",
         .key = "environmentLight",
         .type = "HOW",
         .help = "How the environment's light on a surface is found: " + listed(frame::environmentLightTable()),
         .group = "Environment",
         .panel = SettingPanel::Environment,
         .label = "Light",
         .value = choice(in(&EnvironmentSettings::light), frame::environmentLightTable(),
                         &frame::EnvironmentLightInfo::light)},
        {.name = "environment samples",
         .flag = "--environment-samples",
         .key = "environmentSamples",
         .type = "N",
         .help = "Of sampled: samples of a pixel of the map, and as many of the diffuse part and of each highlight",
         .group = "Environment",
         .panel = SettingPanel::Environment,
         .label = "Light samples",
         .value = choice(in(&EnvironmentSettings::samples), frame::kEnvironmentSamples)},
        {.name = "environment compensation",
         .flag = "--environment-compensation",
         .key = "environmentCompensation",
         .type = "on|off",
         .help = "Whether rough metallic_roughness surfaces get back what light loses that meets them more than once",
         .group = "Environment",
         .panel = SettingPanel::Environment,
         .label = "Compensation",
         .value = onOff(&EnvironmentSettings::compensates)},
        {.name = "environment rotation",
         .flag = "--environment-rotation",
         .key = "environmentRotation",
         .type = "DEGREES",
         .help = "Turns the environment about the vertical, counter-clockwise seen from above",
         .group = "Environment",
         .panel = SettingPanel::Environment,
         .label = "Rotation",
         .sameCost = true,
         .isShared = true,
         .value = number(in(&EnvironmentSettings::rotationDegrees),
                         {.sliderLeast = -180.0f, .sliderMost = 180.0f, .format = "%.0f degrees"})},
        {.name = "environment intensity",
         .flag = "--environment-intensity",
         .key = "environmentIntensity",
         .type = "FACTOR",
         .help = "Multiplies the environment's light",
         .group = "Environment",
         .panel = SettingPanel::Environment,
         .label = "Intensity",
         .isShared = true,
         .value = number(in(&EnvironmentSettings::intensity),
                         {.least = 0.0, .most = 1e6, .sliderLeast = 0.0f, .sliderMost = 4.0f})},
        {.name = "backdrop",
         .flag = "--backdrop",
         .key = "backdrop",
         .type = "HOW",
         .help = "What is seen of the environment behind the scene: " + listed(frame::backdropTable()),
         .group = "Environment",
         .panel = SettingPanel::Environment,
         .sameCost = true,
         .isShared = true,
         .value = choice(in(&EnvironmentSettings::backdrop), frame::backdropTable(), &frame::BackdropInfo::backdrop)},
        {.name = "shadows",
         .flag = "--shadows",
         .key = "shadows",
         .type = "WHICH",
         .help = "Which lights cast shadows: none, those that the scene asks for (asked), all, or the first N",
         .group = "Shadows",
         .panel = SettingPanel::Shadows,
         .value = shadowChoice()},
        {.name = "shadow filter",
         .flag = "--shadow-filter",
         .key = "shadowFilter",
         .type = "NAME",
         .help = "How shadows are found: " + listed(frame::shadowFilterTable()),
         .group = "Shadows",
         .panel = SettingPanel::Shadows,
         .value =
             choice(in(&FrameSettings::shadowFilter), frame::shadowFilterTable(), &frame::ShadowFilterInfo::filter)},
        {.name = "shadow samples",
         .flag = "--shadow-samples",
         .key = "shadowSamples",
         .type = "N",
         .help = "Rays or look-ups of a pixel for a light with a size, whose shadows are soft with traced and pcss",
         .group = "Shadows",
         .panel = SettingPanel::Shadows,
         .ofFilters = &frame::ShadowFilterInfo::heedsSizes,
         .value = wholeNumber(in(&FrameSettings::shadowSamples),
                              {.least = 1, .most = frame::kMostShadowSamples, .isWhole = true})},
        {.name = "shadow width",
         .flag = "--shadow-width",
         .key = "shadowWidth",
         .type = "TEXELS",
         .help = "Of pcf: side of the square that it averages",
         .group = "Shadows",
         .panel = SettingPanel::Shadows,
         .label = "PCF width",
         .ofFilters = &frame::ShadowFilterInfo::heedsWidth,
         .value = choice(in(&ShadowMapSettings::widthTexels), frame::kShadowWidths, " texels")},
        {.name = "shadow resolution",
         .flag = "--shadow-resolution",
         .key = "shadowResolution",
         .type = "TEXELS",
         .help = "Of maps: side of every face",
         .byItself = "by what a light reaches in the picture",
         .group = "Shadows",
         .panel = SettingPanel::Shadows,
         .label = "Face texels",
         .ofFilters = &frame::ShadowFilterInfo::usesMaps,
         .value = choice(in(&ShadowMapSettings::resolutionTexels), frame::kShadowResolutions, " texels")},
        {.name = "shadow budget",
         .flag = "--shadow-budget",
         .key = "shadowBudget",
         .type = "MIB",
         .help = "Of maps: memory of all of a view together; where it is too little, lights get fewer texels or lose "
                 "their shadows",
         .group = "Shadows",
         .panel = SettingPanel::Shadows,
         .label = "Map budget",
         .ofFilters = &frame::ShadowFilterInfo::usesMaps,
         .value =
             number(in(&ShadowMapSettings::budgetMiB),
                    {.least = 0.001, .most = 1024.0, .sliderLeast = 1.0f, .sliderMost = 256.0f, .format = "%.4g MiB"})},
        {.name = "shadow cascades",
         .flag = "--shadow-cascades",
         .key = "shadowCascades",
         .type = "N",
         .help = "Of maps: how many a directional light has, each of a part of the depths",
         .group = "Shadows",
         .panel = SettingPanel::Shadows,
         .label = "Cascades",
         .ofFilters = &frame::ShadowFilterInfo::usesMaps,
         .value = wholeNumber(in(&ShadowMapSettings::cascades),
                              {.least = 1, .most = frame::kMostShadowCascades, .isWhole = true})},
        {.name = "subsurface",
         .flag = "--subsurface",
         .key = "subsurface",
         .type = "METHOD",
         .help = "Subsurface scattering of all materials that have any: " + listed(scenes::subsurfaceMethods()),
         .byItself = "asked: as each material says",
         .group = "Subsurface scattering",
         .panel = SettingPanel::Skin,
         .label = "Method",
         .isOfFrame = true,
         .value = choice(in(&FrameSettings::subsurface), scenes::subsurfaceMethods(),
                         &scenes::SubsurfaceMethodInfo::method, "asked")},
        {.name = "diffusion texels",
         .flag = "--diffusion-texels",
         .key = "diffusionTexels",
         .type = "TEXELS",
         .help = "Of texture_space_diffusion: side of an object's atlas",
         .group = "Subsurface scattering",
         .panel = SettingPanel::Skin,
         .label = "Atlas",
         .isOfFrame = true,
         .value = choice(in(&DiffusionSettings::sideTexels), frame::kDiffusionSides, " texels")},
        {.name = "diffusion gaussians",
         .flag = "--diffusion-gaussians",
         .key = "diffusionGaussians",
         .type = "N",
         .help = "Of texture_space_diffusion: Gaussians of a profile at most; of more, neighbours are merged",
         .group = "Subsurface scattering",
         .panel = SettingPanel::Skin,
         .label = "Gaussians",
         .isOfFrame = true,
         .value = wholeNumber(in(&DiffusionSettings::gaussians),
                              {.least = 1, .most = double(scenes::kMostGaussians), .isWhole = true})},
        {.name = "diffusion half",
         .flag = "--diffusion-half",
         .key = "diffusionHalf",
         .type = "on|off",
         .help = "Of texture_space_diffusion: spread light at half the resolution at which it is computed",
         .group = "Subsurface scattering",
         .panel = SettingPanel::Skin,
         .label = "Half size",
         .isOfFrame = true,
         .value = onOff(&DiffusionSettings::half)},
        {.name = "specular",
         .flag = "--specular",
         .key = "specular",
         .type = "on|off",
         .help = "off leaves the specular lobe out",
         .value = onOff(&FrameSettings::specular)},
        {.name = "filter",
         .flag = "--filter",
         .key = "filter",
         .type = "NAME",
         .help = "Textures by hardware, or exact: level 0 alone, by the sampler's nearest or linear filter in full "
                 "precision",
         .panel = SettingPanel::None,
         .isOfFrame = true,
         .value = choice(in(&FrameSettings::filter), frame::textureFilterTable(), &frame::TextureFilterInfo::filter)},
        {.name = "space",
         .flag = "--space",
         .key = "space",
         .type = "NAME",
         .help = "Lighting in world or view space; the pictures agree",
         .panel = SettingPanel::None,
         .value = choice(in(&FrameSettings::space), frame::lightingSpaceTable(), &frame::LightingSpaceInfo::space)},
        {.name = "prune",
         .flag = "--prune",
         .key = "prune",
         .type = "on|off",
         .help = "off keeps what the scene does not need; the picture is the same",
         .label = "Prune",
         .isOfFrame = true,
         .value = onOff(&FrameSettings::prune)},
        {.name = "exposure",
         .flag = "--exposure",
         .key = "exposureEV",
         .type = "EV",
         .help = "Multiplies the display picture by 2^EV",
         .group = "Display",
         .panel = SettingPanel::View,
         .sameCost = true,
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
         .help = "One of " + namesOf(frame::toneMapTable()),
         .group = "Display",
         .panel = SettingPanel::View,
         .sameCost = true,
         .isShared = true,
         .isRemembered = true,
         .value = choice(in(&FrameSettings::toneMap), frame::toneMapTable(), &frame::ToneMapInfo::toneMap)},
    };
}

bool isDrawable(const Setting& setting, const ViewRequest& request) {
    return setting.isDefault(request) || setting.takes == nullptr || setting.takes(request);
}

/// Why the request's technique does not take the setting's requested value, and which techniques do.
std::string refusalOf(const Setting& setting, const ViewRequest& request) {
    std::vector<std::string_view> able;
    ViewRequest other = request;
    for (const TechniqueInfo& info : techniqueTable()) {
        other.technique = info.technique;
        if (setting.isTaken(other)) able.push_back(info.name);
    }
    return fmt::format("technique {} does not take {} {}{}{}; {} do", infoOf(request.technique).name, setting.name,
                       setting.text(request), setting.refusal.empty() ? "" : ", since ", setting.refusal,
                       fmt::join(able, ", "));
}

// ---- What scenes ask for -------------------------------------------------------------------------------------------

std::string_view typeOf(const scenes::Wish& wish) {
    constexpr std::string_view kTypes[] = {"true or false", "a number", "text", "an array"};
    return kTypes[wish.index()];
}

std::string_view typeOf(const Setting& setting) {
    const SettingKind& kind = setting.value.kind;
    if (const auto* choice = std::get_if<ChoiceKind>(&kind)) return choice->ofNumbers ? "a number" : "text";
    if (std::holds_alternative<NumberKind>(kind)) return "a number";
    if (std::holds_alternative<SwitchKind>(kind)) return "true or false";
    return std::holds_alternative<SizeKind>(kind) ? "an array" : "text";
}

/// A wish as the command line would say it.
std::string textOf(const Setting& setting, const scenes::Wish& wish) {
    const std::string* const word = std::get_if<std::string>(&wish);
    const bool isOpen = word != nullptr && !setting.value.open.empty() && *word == setting.value.open;
    const auto* const choice = std::get_if<ChoiceKind>(&setting.value.kind);
    const bool isCount = choice != nullptr && choice->orCount && std::holds_alternative<double>(wish);
    if (!isOpen && !isCount && typeOf(wish) != typeOf(setting))
        throw InputError(fmt::format("is {}; {} is needed", typeOf(wish), typeOf(setting)));
    if (word != nullptr) return *word;
    if (const auto* list = std::get_if<std::vector<double>>(&wish)) return fmt::format("{}", fmt::join(*list, "x"));
    if (const auto* isOn = std::get_if<bool>(&wish)) return *isOn ? "on" : "off";
    return numberText(std::get<double>(wish));
}

} // namespace

void Setting::read(ViewRequest& request, const std::string& text, const TextSource& source) const {
    value.read(request, text, {source.called.empty() ? name : source.called, source.scene, name});
}

std::string Setting::panelLabel() const {
    std::string text(label.empty() ? name : label);
    if (label.empty()) text.front() = char(std::toupper(static_cast<unsigned char>(text.front())));
    return text;
}

std::string Setting::whyIdle(const ViewRequest& request) const {
    const frame::ShadowFilterInfo& filter = infoOf(request.settings.shadowFilter);
    if (ofFilters == nullptr || filter.*ofFilters) return {};
    std::vector<std::string_view> able;
    for (const frame::ShadowFilterInfo& info : frame::shadowFilterTable())
        if (info.*ofFilters) able.push_back(info.name);
    std::string names(able.front());
    for (std::size_t i = 1; i < able.size(); ++i)
        names += fmt::format("{}{}", i + 1 < able.size() ? ", " : " and ", able[i]);
    return fmt::format("Only {} {} it; the shadow filter is {}", names, able.size() == 1 ? "heeds" : "heed",
                       filter.name);
}

bool Setting::isTaken(const ViewRequest& request) const {
    if (isDefault(request)) return true;
    return isDrawable(*this, request) && (refusal.empty() || isHeededBy(request.technique));
}

std::string Setting::range() const {
    if (const auto* number = std::get_if<NumberKind>(&value.kind)) {
        const bool isBounded = std::isfinite(number->least) && std::isfinite(number->most);
        return isBounded ? boundsText(*number) : "";
    }
    const auto* choice = std::get_if<ChoiceKind>(&value.kind);
    if (choice == nullptr || !choice->ofNumbers) return "";
    std::string text;
    for (const ChoiceKind::Entry& entry : choice->entries)
        text += (text.empty() ? "" : &entry == &choice->entries.back() ? " or " : ", ") + entry.name;
    return text;
}

std::span<const Setting> settingTable() {
    static const std::vector<Setting> table = makeTable();
    return table;
}

const Setting& settingOf(std::string_view key) {
    const auto found = std::ranges::find(settingTable(), key, &Setting::key);
    assert(found != settingTable().end());
    return *found;
}

void requireDrawable(const ViewRequest& request) {
    for (const Setting& setting : settingTable())
        if (!isDrawable(setting, request)) throw InputError(refusalOf(setting, request));
}

void requireTaken(const ViewRequest& request) {
    for (const Setting& setting : settingTable())
        if (!setting.isTaken(request)) throw InputError(refusalOf(setting, request));
}

void takeWishes(const scenes::Scene& scene, const std::string& file, ViewRequest& request,
                const std::function<bool(const Setting& setting)>& isSaid) {
    const scenes::SceneOptions& options = scene.options;
    std::vector<std::string_view> keys{"defaultLight"};
    for (const Setting& setting : settingTable())
        if (setting.isWishable) keys.push_back(setting.key);
    for (const auto& [key, wish] : options.wishes)
        if (std::ranges::find(keys, key) == keys.end())
            throw InputError(
                fmt::format("{}:/options: an options object has no key '{}'; {}", file, key, suggestNames(key, keys)));
    for (const Setting& setting : settingTable()) {
        const auto found = options.wishes.find(setting.key);
        const bool isCamera = setting.key == "camera" && options.camera; // which the scene needs to know itself
        if (found == options.wishes.end() && !isCamera) continue;
        try {
            const std::string text = isCamera ? *options.camera : textOf(setting, found->second);
            if (!isSaid(setting)) setting.read(request, text, {{}, &scene});
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}:/options/{}: {}", file, setting.key, error.what()));
        }
    }
}

} // namespace tessera::engine
