#include "renderer/frame/FrameDefines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "renderer/frame/LightRounds.h"
#include "renderer/frame/ShadowMaps.h"

namespace tessera::frame {

namespace {

/// GLSL list of the sample positions. Without a driver nothing is drawn, and all samples lie at the pixel centre.
std::string samplePlaces(const FrameSpec& spec) {
    std::vector<glm::vec2> places = spec.settings.samplePlaces;
    places.resize(std::size_t(spec.samples), glm::vec2(0.5f));
    std::vector<std::string> texts;
    for (const glm::vec2& place : places) texts.push_back(fmt::format("vec2({}, {})", place.x, place.y));
    return fmt::format("{}", fmt::join(texts, ", "));
}

} // namespace

Defines sampleDefines(const FrameSpec& spec) {
    Defines defines{{"SAMPLES", std::to_string(spec.samples)}};
    if (spec.samples > 1) defines.emplace_back("SAMPLE_PLACES", samplePlaces(spec));
    return defines;
}

Defines frameDefines(const FrameSpec& spec) {
    Defines defines = featureDefines(spec.features);
    defines.emplace_back("VIEW", std::to_string(shaderView(spec.settings.view)));
    defines.emplace_back("FILTER_EXACT", spec.settings.filter == TextureFilter::Exact ? "1" : "0");
    defines.emplace_back("LIGHTS_PER_ROUND", std::to_string(lightsPerRound(spec.lights)));
    defines.emplace_back("SPECULAR_OFF", spec.settings.specular ? "0" : "1");
    const Defines ofSamples = sampleDefines(spec);
    defines.insert(defines.end(), ofSamples.begin(), ofSamples.end());
    if (spec.features[Feature::ShadowMaps]) {
        defines.emplace_back("SHADOW_FILTER", std::to_string(int(spec.settings.shadowFilter)));
        defines.emplace_back("SHADOW_CASCADES", std::to_string(spec.settings.shadowMaps.cascades));
        defines.emplace_back("SHADOW_TAP_TEXELS", std::to_string(shadowTapTexels(spec.settings)));
        defines.emplace_back("SHADOW_WIDTH", std::to_string(spec.settings.shadowMaps.widthTexels));
    }
    defines.emplace_back("HAS_SCENE_BEHIND", spec.showsBehindGlass ? "1" : "0");
    defines.emplace_back("HAS_BLURRED_SCENE_BEHIND", spec.blursBehindGlass ? "1" : "0");
    defines.emplace_back("HAS_SCATTERING_SHEETS", spec.scattersBySheets ? "1" : "0");
    defines.emplace_back("HAS_PASSING_LOBES", spec.passesByLobes ? "1" : "0");
    const bool areParallel = infoOf(spec.settings.refraction).farSide == RefractionInfo::FarSide::Parallel;
    defines.emplace_back("HAS_PARALLEL_SIDES", areParallel ? "1" : "0");
    defines.emplace_back("HAS_BACK_FACES", spec.drawsFarSides ? "1" : "0");
    const bool areClosed = infoOf(spec.settings.refraction).farSide == RefractionInfo::FarSide::BackFacesOfClosed;
    if (spec.drawsFarSides) defines.emplace_back("BACK_FACES_OF_CLOSED", areClosed ? "1" : "0");
    defines.emplace_back("IN_ATLAS", spec.isInAtlas() ? "1" : "0");
    if (spec.isInAtlas()) {
        const int side = spec.settings.sizePixels.x;
        defines.emplace_back("ATLAS_TEXELS", std::to_string(side));
        const int border = borderTexels(spec.gutterTexels, spec.diffusionTexels()) * (side / spec.diffusionTexels());
        defines.emplace_back("ATLAS_BORDER", std::to_string(border));
    }
    if (spec.features[Feature::SubsurfaceDiffusion]) {
        const DiffusionAtlas cells = spec.diffusionAtlas();
        defines.emplace_back("DIFFUSION_CELL_TEXELS", std::to_string(cells.sideTexels));
        defines.emplace_back("DIFFUSION_CELL_COLUMNS", std::to_string(cells.columns));
        defines.emplace_back("DIFFUSION_CELL_ROWS", std::to_string(cells.rows));
    }
    if (spec.features[Feature::Environment]) {
        defines.emplace_back("ENVIRONMENT_LIGHT", std::to_string(int(spec.settings.environment.light)));
        defines.emplace_back("ENVIRONMENT_COMPENSATION", spec.compensatesLobes() ? "1" : "0");
    }
    if (spec.usesEnvironmentSamples())
        defines.emplace_back("ENVIRONMENT_SAMPLES", std::to_string(spec.settings.environment.samples));
    if (spec.features.areaLights())
        defines.emplace_back("AREA_SAMPLES", std::to_string(spec.usesAreaSamples() ? spec.settings.area.samples : 0));
    if (spec.tracesShadows()) defines.emplace_back("CASTER_STEPS", std::to_string(casterSteps(spec.shadowSamples)));
    if (spec.features[Feature::SoftShadows])
        defines.emplace_back("SHADOW_SAMPLES", std::to_string(spec.settings.shadowSamples));
    if (spec.hook) {
        const Defines ofHook = hookDefines(*spec.hook);
        defines.insert(defines.end(), ofHook.begin(), ofHook.end());
    }
    return defines;
}

} // namespace tessera::frame
