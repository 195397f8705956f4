#include "engine/SettingRows.h"

#include <algorithm>

#include "engine/SettingValues.h"

namespace tessera::engine {

namespace {

using frame::DiffusionSettings, frame::EnvironmentSettings, frame::FrameSettings, frame::ShadowMapSettings;

struct ShadowChoice {
    scenes::ShadowRequest request;
    std::string_view name, summary;
};
constexpr ShadowChoice kShadowChoices[] = {
    {{scenes::ShadowRequest::Kind::None}, "none", "no light casts shadows"},
    {{scenes::ShadowRequest::Kind::Scene}, "scene", "lights with castsShadow cast shadows"},
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

} // namespace

std::vector<Setting> environmentSettings() {
    return {
        {.name = "environment light",
         .flag = "--environment-light",
         .key = "environmentLight",
         .type = "HOW",
         .help = "How the environment's light on a surface is found: " + listed(frame::environmentLightTable()),
         .group = "Environment",
         .panel = SettingPanel::Environment,
         .label = "Integration",
         .ofEnvironment = true,
         .value = choice(in(&EnvironmentSettings::light), frame::environmentLightTable(),
                         &frame::EnvironmentLightInfo::light)},
        {.name = "environment samples",
         .flag = "--environment-samples",
         .key = "environmentSamples",
         .type = "N",
         .help = "With sampled: how many samples a pixel takes by the map, by the diffuse part and by each highlight",
         .group = "Environment",
         .panel = SettingPanel::Environment,
         .label = "Light samples",
         .ofEnvironment = true,
         .ofLight = &frame::EnvironmentLightInfo::usesSamples,
         .value = choice(in(&EnvironmentSettings::samples), frame::kEnvironmentSamples)},
        {.name = "environment compensation",
         .flag = "--environment-compensation",
         .key = "environmentCompensation",
         .type = "on|off",
         .help = "Whether rough metallic_roughness surfaces reflect multiple scattering between microfacets too",
         .group = "Environment",
         .panel = SettingPanel::Environment,
         .label = "Compensation",
         .ofEnvironment = true,
         .ofLight = &frame::EnvironmentLightInfo::lights,
         .value = onOff(&EnvironmentSettings::compensates)},
        {.name = "environment rotation",
         .flag = "--environment-rotation",
         .key = "environmentRotation",
         .type = "DEGREES",
         .help = "Turns the environment about the vertical, counter-clockwise seen from above",
         .group = "Environment",
         .panel = SettingPanel::Environment,
         .label = "Rotation",
         .ofEnvironment = true,
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
         .ofEnvironment = true,
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
         .ofEnvironment = true,
         .sameCost = true,
         .entersLight = false,
         .isShared = true,
         .value = choice(in(&EnvironmentSettings::backdrop), frame::backdropTable(), &frame::BackdropInfo::backdrop)},
        {.name = "refraction",
         .flag = "--refraction",
         .key = "refraction",
         .type = "HOW",
         .help = "What bodies of glass show: " + listed(frame::refractionTable()),
         .group = "Environment",
         .panel = SettingPanel::Environment,
         .entersLight = false,
         .value = choice(in(&FrameSettings::refraction), frame::refractionTable(), &frame::RefractionInfo::refraction)},
        {.name = "glass depth",
         .flag = "--glass-depth",
         .key = "glassDepth",
         .type = "N",
         .help =
             "How many bodies and sheets of glass a ray that another has bent meets in turn, in the reference alone: "
             "techniques show opaque surfaces and lights behind glass",
         .group = "Environment",
         .panel = SettingPanel::None,
         .ofReference = true,
         .sameCost = true,
         .entersLight = false,
         .value = choice(in(&FrameSettings::glassDepth), frame::kGlassDepths)},
    };
}

std::vector<Setting> shadowSettings() {
    return {
        {.name = "shadows",
         .flag = "--shadows",
         .key = "shadows",
         .type = "WHICH",
         .help = "Which lights cast shadows: none, those that the scene requests (scene), all, or the first N",
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
        {.name = "shadow terminator",
         .flag = "--shadow-terminator",
         .key = "shadowTerminator",
         .type = "WHERE",
         .help = "Where shadow rays of smooth-shaded triangles start: " + listed(frame::shadowTerminatorTable()),
         .group = "Shadows",
         .panel = SettingPanel::Shadows,
         .label = "Terminator",
         .value = choice(in(&FrameSettings::shadowTerminator), frame::shadowTerminatorTable(),
                         &frame::ShadowTerminatorInfo::terminator)},
        {.name = "shadow samples",
         .flag = "--shadow-samples",
         .key = "shadowSamples",
         .type = "N",
         .help = "With traced or pcss: rays or look-ups of a pixel for each light with a size, whose shadows are soft",
         .group = "Shadows",
         .panel = SettingPanel::Shadows,
         .ofFilters = &frame::ShadowFilterInfo::usesSizes,
         .value = wholeNumber(in(&FrameSettings::shadowSamples),
                              {.least = 1, .most = frame::kMostShadowSamples, .isWhole = true})},
        {.name = "shadow width",
         .flag = "--shadow-width",
         .key = "shadowWidth",
         .type = "TEXELS",
         .help = "With pcf: side of the square that it averages",
         .group = "Shadows",
         .panel = SettingPanel::Shadows,
         .label = "PCF width",
         .ofFilters = &frame::ShadowFilterInfo::usesWidth,
         .value = choice(in(&ShadowMapSettings::widthTexels), frame::kShadowWidths, " texels")},
        {.name = "shadow resolution",
         .flag = "--shadow-resolution",
         .key = "shadowResolution",
         .type = "TEXELS",
         .help = "With shadow maps: side of every face",
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
         .help =
             "With shadow maps: memory of all maps of a view; where it is too little, lights get fewer texels or lose "
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
         .help = "With shadow maps: how many a directional light has, each for a part of the depths",
         .group = "Shadows",
         .panel = SettingPanel::Shadows,
         .label = "Cascades",
         .ofFilters = &frame::ShadowFilterInfo::usesMaps,
         .value = wholeNumber(in(&ShadowMapSettings::cascades),
                              {.least = 1, .most = frame::kMostShadowCascades, .isWhole = true})},
    };
}

std::vector<Setting> subsurfaceSettings() {
    return {
        {.name = "subsurface",
         .flag = "--subsurface",
         .key = "subsurface",
         .type = "METHOD",
         .help = "Subsurface scattering of all materials that request some: " + listed(scenes::subsurfaceMethods()),
         .byItself = "material: as each material says",
         .group = "Subsurface scattering",
         .panel = SettingPanel::Skin,
         .label = "Method",
         .isOfFrame = true,
         .value = choice(in(&FrameSettings::subsurface), scenes::subsurfaceMethods(),
                         &scenes::SubsurfaceMethodInfo::method, "material")},
        {.name = "diffusion texels",
         .flag = "--diffusion-texels",
         .key = "diffusionTexels",
         .type = "TEXELS",
         .help = "With texture_space_diffusion: side of an object's atlas",
         .group = "Subsurface scattering",
         .panel = SettingPanel::Skin,
         .label = "Atlas",
         .isOfFrame = true,
         .value = choice(in(&DiffusionSettings::sideTexels), frame::kDiffusionSides, " texels")},
        {.name = "diffusion gaussians",
         .flag = "--diffusion-gaussians",
         .key = "diffusionGaussians",
         .type = "N",
         .help = "With texture_space_diffusion: the most Gaussians of a profile; of more, neighbours are merged",
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
         .help = "With texture_space_diffusion: diffuse light at half the resolution at which it is computed",
         .group = "Subsurface scattering",
         .panel = SettingPanel::Skin,
         .label = "Half size",
         .isOfFrame = true,
         .value = onOff(&DiffusionSettings::half)},
    };
}

} // namespace tessera::engine
