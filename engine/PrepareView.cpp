#include "engine/PrepareView.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "base/Error.h"
#include "engine/ChooseCulling.h"
#include "engine/ChooseLighting.h"
#include "engine/ChooseSamples.h"
#include "engine/ChooseView.h"
#include "engine/Settings.h"
#include "renderer/culling/TileGrid.h"
#include "renderer/frame/CasterTree.h"
#include "renderer/frame/LightBuffer.h"
#include "renderer/frame/LightRounds.h"
#include "scenes/Limits.h"

namespace tessera::engine {

scenes::Camera frameCamera(const scenes::Scene& scene, const frame::FrameSettings& settings) {
    scenes::Camera camera = scene.cameras[std::size_t(settings.camera)];
    camera.worldFromCamera[3] += glm::dvec4(settings.eyeOffsetWS, 0.0);
    return camera;
}

void requireOneFrame(std::span<const ViewRequest> views) {
    if (views.empty()) throw std::logic_error("a frame needs a view");
    for (const ViewRequest& view : views) {
        for (const Setting& setting : settingTable())
            if (setting.isOfFrame && !setting.value.equal(view, views.front()))
                throw InputError(fmt::format("views of a frame have {} {} and {} {}; give all of them the same",
                                             setting.name, setting.text(views.front()), setting.name,
                                             setting.text(view)));
    }
}

std::string lostShadows(const frame::ShadowMaps& maps, const frame::FrameSettings& settings) {
    if (maps.unmapped() == 0) return "";
    return fmt::format("the budget of {:g} MiB has no room for the maps of {}, which cast no shadows; give more {}",
                       settings.shadowMaps.budgetMiB, frame::lightsText(maps.unmapped()),
                       settingOf("shadowBudget").flag);
}

namespace {

/// Warning: shadows lost by the map budget or by rounding of casters or maps; empty if none.
std::string shadowsLostByRounding(std::span<const frame::SurfaceBounds> bounds, const frame::PreparedView& prepared) {
    const frame::ShadowMaps& maps = prepared.shadowMaps;
    if (std::string lost = lostShadows(maps, prepared.spec.settings); !lost.empty()) return lost;
    const auto longest = std::ranges::max_element(bounds, {}, &frame::SurfaceBounds::longestMetres);
    if (prepared.lights.shadowed == 0 || longest == bounds.end()) return "";
    if (const double errorMetres = frame::kPositionRounding * longest->longestMetres;
        errorMetres > frame::usualMetres(bounds))
        return fmt::format(
            "a triangle {:.2g} m long is rounded by {:.2g} m, more than most triangles are apart, so that "
            "shadows are lost; take it out",
            longest->longestMetres, errorMetres);
    if (maps.useless() == 0) return "";
    return fmt::format("the maps of {} err by more than the {:.2g} m that most triangles lie within, so that shadows "
                       "are lost; take out what is drawn far away, or give {} traced or more {}",
                       frame::lightsText(maps.useless()), maps.usualMetres, settingOf("shadowFilter").flag,
                       settingOf("shadowBudget").flag);
}

/// A penumbra in a map extends at most an eighth of the map's side, a third of the radius of the sphere that the map
/// covers. At this angular radius, a caster at 0.58 of that radius has such a penumbra.
constexpr double kWidestPcssRadians = std::numbers::pi / 6.0;

/// Warning: a sun whose penumbrae exceed the search radius of pcss; empty if there is none.
std::string penumbraeTooWide(const scenes::Scene& scene, const frame::PreparedView& prepared) {
    const frame::ShadowFilterInfo& filter = infoOf(prepared.spec.settings.shadowFilter);
    if (!filter.usesMaps || !filter.usesSizes) return "";
    for (std::size_t i = 0; i < prepared.lights.shadowed; ++i) {
        const scenes::Light& light = scene.lights[std::size_t(prepared.lights.sceneIndex[i])];
        if (light.type != scenes::LightType::Directional || double(light.angularRadiusRadians) <= kWidestPcssRadians)
            continue;
        return fmt::format("{} truncates the penumbrae of a sun of {:.3g} degrees, which then looks too bright; "
                           "give {} traced, or no more than {:.3g} degrees",
                           filter.name, glm::degrees(double(light.angularRadiusRadians)),
                           settingOf("shadowFilter").flag, glm::degrees(kWidestPcssRadians));
    }
    return "";
}

/// Prefixes a warning about an object lit for diffusion, which has separate lights and shadow maps.
std::string ofObject(const frame::DiffusionObject& object, const std::string& said) {
    return said.empty() ? "" : fmt::format("when lighting {} for diffusion: {}", object.name, said);
}

} // namespace

std::string missingShadows(const scenes::Scene& scene, std::span<const frame::SurfaceBounds> bounds,
                           const frame::PreparedView& prepared) {
    const frame::FrameSettings& settings = prepared.spec.settings;
    if (!frame::showsShadows(settings.view)) return "";
    const frame::DebugViewInfo& view = frame::debugViewInfo(settings.view);
    if (frame::showsShadowsOfOne(settings.view) || frame::showsMaps(settings.view)) {
        if (prepared.lights.shadowed == 0)
            return fmt::format("the view {} has no shadow to show: {}", view.name,
                               frame::whyNoShadows(scene, prepared.lights, settings.shadows));
        if (frame::showsMaps(settings.view) && !infoOf(settings.shadowFilter).usesMaps)
            return fmt::format("the view {} has no map to show: the shadow filter {} uses none; give {} hard",
                               view.name, infoOf(settings.shadowFilter).name, settingOf("shadowFilter").flag);
    }
    if (std::string lost = shadowsLostByRounding(bounds, prepared); !lost.empty()) return lost;
    for (std::size_t i = 0; i < prepared.diffusionViews.size(); ++i)
        if (std::string lost =
                ofObject(prepared.diffusionObjects[i], shadowsLostByRounding(bounds, prepared.diffusionViews[i]));
            !lost.empty())
            return lost;
    return penumbraeTooWide(scene, prepared);
}

std::string invisibleDiffusion(const scenes::Scene& scene, const frame::PreparedView& prepared) {
    std::string first;
    std::size_t others = 0;
    for (std::size_t i = 0; i < prepared.diffusionViews.size(); ++i) {
        const frame::DiffusionObject& object = prepared.diffusionObjects[i];
        const scenes::Material& material = scene.materials[std::size_t(object.material)];
        double widest = 0.0; // mm^2
        for (const scenes::DiffusionGaussian& gaussian : scenes::profileOf(material.subsurface))
            widest = std::max(widest, double(gaussian.varianceSquareMillimetres));
        const frame::FrameSpec& spec = prepared.diffusionViews[i].spec;
        if (!spec.diffusionKernel->levels.empty() || widest == 0.0) continue;
        if (!first.empty()) {
            ++others;
            continue;
        }
        const double texelMetres = spec.diffusionKernel->texelMetres * double(material.subsurface.scaleMetres);
        first = fmt::format("light is not diffused over {} (material '{}'): its widest Gaussian is {:.3g} mm, and a "
                            "texel of its atlas {:.3g} mm; scaleMetres of the subsurface says how many metres a metre "
                            "of the model is, and {} how many texels there are",
                            object.name, material.name, std::sqrt(widest), 1e3 * texelMetres,
                            settingOf("diffusionTexels").flag);
    }
    if (others > 0) first += fmt::format("; nor over {} other object{}", others, others == 1 ? "" : "s");
    return first;
}

CutShadows cutShadows(const frame::PreparedView& prepared) {
    const frame::FrameSpec& spec = prepared.spec;
    if (!spec.mayCutLoops()) {
        for (std::size_t i = 0; i < prepared.diffusionViews.size(); ++i)
            if (const CutShadows cut = cutShadows(prepared.diffusionViews[i]); !cut.why.empty())
                return {ofObject(prepared.diffusionObjects[i], cut.why), cut.iterations};
        return {};
    }
    if (spec.usesAreaSamples()) {
        const std::size_t samples = spec.areaLights * std::size_t(spec.settings.area.samples);
        if (2 * samples > spec.iterations)
            return {fmt::format("samples of {} take up to {} iterations of a shader's loops where all reach a pixel, "
                                "and Mesa ends those after {}, which gives NaN; give fewer {}",
                                frame::lightsText(spec.areaLights), spec.iterations, frame::kMostLoopIterations,
                                settingOf("areaSamples").flag),
                    spec.iterations};
    }
    const bool mayNarrow =
        infoOf(spec.settings.shadowFilter).usesWidth && spec.settings.shadowMaps.widthTexels > frame::kShadowWidths[0];
    const std::string fewer = mayNarrow ? fmt::format("a smaller {} or ", settingOf("shadowWidth").flag)
                              : spec.features[frame::Feature::SoftShadows]
                                  ? fmt::format("fewer {} or ", settingOf("shadowSamples").flag)
                                  : "";
    return {fmt::format("shadows of {} take up to {} iterations of a shader's loops where all reach a pixel, and Mesa "
                        "ends those after {}, which "
                        "gives NaN; give {}shadows to fewer lights ({} N)",
                        frame::lightsText(spec.shadowedLights), spec.iterations, frame::kMostLoopIterations, fewer,
                        settingOf("shadows").flag),
            spec.iterations};
}

namespace {

void addShadowMaps(const scenes::Scene& scene, std::span<const frame::SurfaceBounds> bounds,
                   frame::PreparedView& prepared) {
    std::vector<frame::SurfaceBounds> own;
    if (bounds.empty()) bounds = own = frame::surfaceBounds(scene); // a plan
    frame::FrameSpec& spec = prepared.spec;
    prepared.shadowMaps = frame::makeShadowMaps(scene, prepared.lights, prepared.camera, spec.settings, bounds);
    const std::size_t lightTexels = frame::lightBytes(spec.features, prepared.lights.texels.size()) / sizeof(glm::vec4);
    prepared.shadowFaces = frame::packFaces(prepared.shadowMaps, prepared.camera, lightTexels, bounds, prepared.lights);
    spec.shadowAtlasTexels = prepared.shadowMaps.atlasTexels;
    spec.shadowFaces = prepared.shadowMaps.faces.size();
}

void addEnvironment(const scenes::Scene& scene, frame::PreparedView& prepared) {
    if (!prepared.spec.environment) return;
    prepared.environment = frame::packEnvironment(*scene.environment, prepared.spec.settings, prepared.camera);
}

/// Finds the lights that reach the camera's view, and other inputs of its lighting. `makeSpec` makes the spec from the
/// lights.
template <typename MakeSpec>
void lightView(const scenes::Scene& scene, const frame::FrameSettings& settings, const MakeSpec& makeSpec,
               frame::PreparedView& prepared) {
    prepared.lights = frame::packLights(scene, prepared.camera, settings);
    const std::size_t count = prepared.lights.texels.size();
    prepared.lighting.lights = glm::uvec4(count, prepared.lights.shown, prepared.lights.everywhere, (count + 31) / 32);
    prepared.lighting.slices.y = glm::uint(prepared.lights.shadowed);
    prepared.spec = makeSpec(prepared.lights);
    addEnvironment(scene, prepared);
    if (scene.hook) prepared.hook = frame::hookConstants(*scene.hook, settings.timeSeconds);
}

/// Prepares the diffusion view that lights an object's texels. Its camera covers the whole object, so that lights are
/// culled against the object, independent of the frame's camera.
frame::PreparedView prepareDiffusion(const scenes::Scene& scene, const frame::DiffusionObject& object,
                                     frame::FrameSettings settings, std::span<const frame::SurfaceBounds> bounds) {
    settings.sizePixels = glm::ivec2(settings.diffusion.sideTexels);
    settings.wholePixels.reset();
    settings.samples = 1;
    settings.samplePlaces.clear();
    settings.eyeOffsetWS = glm::dvec3(0.0);
    settings.view = frame::DebugView::Final;
    settings.space = frame::LightingSpace::World;
    settings.display = false;
    settings.culling = {};

    const glm::dvec3 center = 0.5 * (object.boxWS.min + object.boxWS.max);
    const double radius =
        std::max(0.51 * glm::distance(object.boxWS.min, object.boxWS.max), 1e-9 * (1.0 + glm::length(center)));
    scenes::Camera camera;
    camera.projection = scenes::Projection::Orthographic;
    camera.worldFromCamera[3] = glm::dvec4(center + glm::dvec3(0.0, 0.0, 2.0 * radius), 1.0);
    camera.halfHeightMetres = radius;
    camera.nearMetres = 0.5 * radius;
    const frame::SurfaceBounds own{.boxWS = object.boxWS, .reachMetres = radius, .nodeWS = center};

    frame::PreparedView prepared;
    prepared.camera = frame::makeCameraView(camera, settings.sizePixels, settings.space, glm::vec3(0.0f), {&own, 1},
                                            settings.snapPixels);
    const auto makeSpec = [&](const frame::PackedLights& lights) {
        return frame::makeDiffusionSpec(scene, object, lights, settings);
    };
    lightView(scene, settings, makeSpec, prepared);
    if (prepared.spec.features[frame::Feature::ShadowMaps]) addShadowMaps(scene, bounds, prepared);
    return prepared;
}

void addDiffusion(const scenes::Scene& scene, std::span<const frame::SurfaceBounds> bounds,
                  frame::PreparedView& prepared) {
    std::vector<frame::SurfaceBounds> own;
    if (bounds.empty()) bounds = own = frame::surfaceBounds(scene); // a plan
    frame::FrameSpec& spec = prepared.spec;
    prepared.diffusionObjects = frame::diffusionObjects(scene, spec.settings.subsurface, bounds);
    if (prepared.diffusionObjects.size() > kMostDiffusionObjects)
        throw InputError(
            fmt::format("{}: light is diffused over {} objects, {} is the most; give some of their materials "
                        "another subsurface method",
                        scene.name, prepared.diffusionObjects.size(), kMostDiffusionObjects));
    const glm::ivec2 texels = frame::diffusionAtlas(prepared.diffusionObjects.size(), spec.diffusionTexels()).texels();
    const double gibibytes = double(texels.x) * double(texels.y) * sizeof(glm::vec4) / double(1u << 30u);
    if (std::max(texels.x, texels.y) > frame::kLargestSidePixels || gibibytes > kMostDiffusionGibibytes)
        throw InputError(fmt::format(
            "{}: light is diffused over {} objects, whose atlases of {} texels a side together have "
            "{}x{} and take {:.1f} GiB; {} texels a side and {:g} GiB are the most; give a "
            "smaller {}",
            scene.name, prepared.diffusionObjects.size(), spec.diffusionTexels(), texels.x, texels.y, gibibytes,
            frame::kLargestSidePixels, kMostDiffusionGibibytes, settingOf("diffusionTexels").flag));
    for (const frame::DiffusionObject& object : prepared.diffusionObjects) {
        prepared.diffusionViews.push_back(prepareDiffusion(scene, object, spec.settings, bounds));
        spec.diffusionViews.push_back(prepared.diffusionViews.back().spec);
    }
}

} // namespace

frame::PreparedView prepareView(const scenes::Scene& scene, Technique technique, const frame::FrameSettings& settings,
                                std::span<const frame::SurfaceBounds> bounds) {
    if (settings.sizePixels.x < 1 || settings.sizePixels.y < 1) {
        throw InputError(
            fmt::format("a picture of {}x{} pixels has no pixel", settings.sizePixels.x, settings.sizePixels.y));
    }
    if (settings.camera < 0 || settings.camera >= int(scene.cameras.size())) {
        throw InputError(fmt::format("{}: there is no camera {}; the scene has {}", scene.name, settings.camera,
                                     scene.cameras.size()));
    }
    if (settings.soloLight && (*settings.soloLight < 0 || *settings.soloLight >= int(scene.lights.size()))) {
        throw InputError(fmt::format("{}: there is no light {} to show alone; the scene has {} (0 to {})", scene.name,
                                     *settings.soloLight, scene.lights.size(), int(scene.lights.size()) - 1));
    }
    scenes::requireDrawableLights(scene.name, scene.lights.size());
    requireDrawable({technique, settings});
    const int samples = chooseSamples(settings);
    if (!(settings.rangeTolerance >= 0.0) || std::isinf(settings.rangeTolerance)) {
        throw InputError(fmt::format("a range tolerance of {} ends no light; give 0, which keeps all of it, or more",
                                     settings.rangeTolerance));
    }
    frame::PreparedView prepared;
    const scenes::Camera camera = frameCamera(scene, settings);
    // A debug view shows quantities of surfaces; where there is none it shows 0.
    const glm::vec3 background = frame::showsLitPicture(settings.view) ? scene.background : glm::vec3(0.0f);
    const std::vector<frame::SeenLight> seenLights = frame::seenLights(scene, camera, settings);
    std::vector<frame::SurfaceBounds> withLights;
    if (!seenLights.empty()) withLights.assign(bounds.begin(), bounds.end());
    for (const frame::SeenLight& seen : seenLights) withLights.push_back(seen.bounds);
    prepared.camera =
        frame::makeCameraView(camera, settings.sizePixels, settings.space, background,
                              seenLights.empty() ? bounds : withLights, settings.snapPixels, settings.offsetPixels);
    prepared.camera.constants.sizePixels.z = glm::uint(samples);
    if (frame::showsLitPicture(settings.view)) prepared.seenLights = frame::packSeenLights(seenLights, prepared.camera);
    const auto makeSpec = [&](const frame::PackedLights& lights) {
        return frame::makeFrameSpec(scene, lights, settings, prepared.seenLights.size());
    };
    lightView(scene, settings, makeSpec, prepared);
    frame::FrameSpec& spec = prepared.spec;
    spec.samples = samples;
    spec.background = prepared.camera.constants.background;
    spec.showsLightPictures = spec.seenLights > 0 && std::ranges::any_of(seenLights, [](const frame::SeenLight& seen) {
                                  return seen.picture >= 0;
                              });
    requireStoredChannel(spec);
    if (spec.features[frame::Feature::ShadowMaps]) addShadowMaps(scene, bounds, prepared);
    if (spec.features[frame::Feature::SubsurfaceDiffusion]) addDiffusion(scene, bounds, prepared);
    spec.lightOn = chooseLighting(settings);
    spec.culling = chooseCulling(technique, settings, spec.features, prepared.lights);
    // These views light nothing, and no lists are built for them.
    if (settings.view == frame::DebugView::Ids || settings.view == frame::DebugView::ShadowAtlas) spec.culling = {};
    if (spec.culling.method == culling::Method::None) return prepared;
    spec.lightsEverywhere = !settings.prune || prepared.lights.everywhere > 0;
    culling::setTileGrid(prepared.lighting, prepared.camera.constants, spec.culling.tilePixels);
    prepared.cullLights = frame::cullLights(prepared.lights, prepared.camera);
    return prepared;
}

} // namespace tessera::engine
