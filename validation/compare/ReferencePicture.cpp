#include "validation/compare/ReferencePicture.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/Error.h"
#include "engine/HookedSurfaces.h"
#include "engine/PrepareView.h"
#include "renderer/frame/EnvironmentMap.h"
#include "renderer/frame/MaterialFeatures.h"
#include "scenes/InUse.h"

namespace tessera::validation {

reference::Settings referenceSettings(const scenes::Scene& scene, const frame::FrameSettings& settings) {
    reference::Settings result;
    result.sizePixels = settings.sizePixels;
    result.camera = engine::frameCamera(scene, settings);
    result.timeSeconds = settings.timeSeconds;
    result.soloLight = settings.soloLight;
    result.shadows = settings.shadows;
    result.softensTerminators = settings.shadowTerminator == frame::ShadowTerminator::Softened;
    result.subsurface = settings.subsurface;
    // Ray noise is tolerated for traced shadows only.
    result.shadowSamples = infoOf(settings.shadowFilter).usesMaps ? 0 : settings.shadowSamples;
    result.environmentLights = settings.environment.light != frame::EnvironmentLight::Off;
    result.environmentCompensates = settings.environment.compensates;
    result.environmentIsSeen = scene.environment && settings.environment.backdrop != frame::Backdrop::Off;
    result.environmentIntensity = double(settings.environment.intensity);
    result.environmentRotationDegrees = double(settings.environment.rotationDegrees);
    result.bodiesShowScene = infoOf(settings.refraction).showsScene;
    result.glassDepth = settings.glassDepth;
    using FarSide = frame::RefractionInfo::FarSide;
    const FarSide farSide = infoOf(settings.refraction).farSide;
    result.farSide = farSide == FarSide::Parallel            ? reference::FarSide::Parallel
                     : farSide == FarSide::BackFaces         ? reference::FarSide::BackFaces
                     : farSide == FarSide::BackFacesOfClosed ? reference::FarSide::BackFacesOfClosed
                                                             : reference::FarSide::None;
    result.specular = settings.specular;
    result.rangeTolerance = settings.rangeTolerance;
    result.filtering =
        settings.filter == frame::TextureFilter::Exact ? reference::Filtering::Exact : reference::Filtering::Hardware;
    // The product reads the reflectance of rough glass from a table of lobes, whose RMS error is up to 1e-4 of the
    // light and whose mean error 6e-5. At a transmittance of 1/8 these are 8e-4 and 4.7e-4 of the transmitted light,
    // within the tolerances of relMse, 1e-6, and of the bias, 5e-4.
    result.leastRoughTransmittance = 0.125;
    return result;
}

void requireReferenceSupports(const frame::FrameSettings& settings) {
    if (settings.view != frame::DebugView::Final) {
        throw InputError(fmt::format("the reference renders the view final only, not {}; set the view to final",
                                     frame::debugViewInfo(settings.view).name));
    }
    if (settings.samples != 1) {
        throw InputError(
            fmt::format("the reference takes one sample a pixel, not {}; set samples to 1", settings.samples));
    }
}

namespace {

/// Rejects diffusion in hooked materials: entry points are found during lighting, too late to run the hook there.
void requireNoDiffusion(const scenes::Scene& scene, const scenes::SubsurfaceRequest& subsurface) {
    for (const int place : scene.hook->materials) {
        const scenes::Material& material = scene.materials[std::size_t(place)];
        if (infoOf(scenes::subsurfaceOf(material, subsurface)).diffuses)
            throw InputError(fmt::format("{}: the reference diffuses no light below '{}', which the hook "
                                         "changes; give --subsurface depth_map, wrap or none",
                                         scene.name, material.name));
    }
}

ReferencePicture pictureOf(const scenes::Scene& scene, const frame::FrameSettings& settings,
                           const std::function<void()>& rowDone, Alternatives alternatives,
                           reference::RunHook runHook) {
    requireReferenceSupports(settings);
    engine::prepareView(scene, engine::Technique::Forward, settings); // throws for names that the scene lacks
    reference::Settings wanted = referenceSettings(scene, settings);
    wanted.runHook = std::move(runHook);
    wanted.findsAlternatives = alternatives != Alternatives::None;
    if (alternatives != Alternatives::DefinitionAndNoise) wanted.shadowSamples = 0;
    reference::Rendered rendered = reference::render(scene, wanted, rowDone);
    ReferencePicture result;
    result.picture.width = rendered.width;
    result.picture.height = rendered.height;
    result.picture.rgba.reserve(4 * rendered.radiance.size());
    for (std::size_t i = 0; i < rendered.radiance.size(); ++i) {
        for (int c = 0; c < 3; ++c) result.picture.rgba.push_back(float(rendered.radiance[i][c]));
        result.picture.rgba.push_back(float(rendered.covered[i]));
    }
    result.picture.covered = std::move(rendered.covered);
    result.ids = std::move(rendered.ids);
    result.alternatives = std::move(rendered.alternatives);
    result.undecidedShadows = std::move(rendered.undecidedShadows);
    result.shadowNoise = std::move(rendered.shadowNoise);
    result.diffused = std::move(rendered.diffused);
    result.surroundings = std::move(rendered.surroundings);
    result.areaLights = std::move(rendered.areaLights);
    result.errorWeights = std::move(rendered.errorWeights);
    return result;
}

} // namespace

ReferencePicture referencePicture(const scenes::Scene& scene, const frame::FrameSettings& settings,
                                  const std::function<void()>& rowDone, Alternatives alternatives) {
    // A scene whose vertices a renderer has already moved is an ordinary scene.
    if (scene.hook && (scene.hook->changesSurfaces || scene.hook->movesVertices))
        throw InputError(
            fmt::format("{}: the reference runs no shaders, and so no hook without a renderer; take '{}' out",
                        scene.name, scene.hook->file));
    return pictureOf(scene, settings, rowDone, alternatives, {});
}

ReferencePicture referencePicture(engine::Renderer& renderer, const frame::FrameSettings& settings,
                                  const std::function<void()>& rowDone, Alternatives alternatives) {
    const scenes::Scene& scene = renderer.sceneAt(settings.timeSeconds);
    reference::RunHook runHook;
    if (scene.hook && scene.hook->changesSurfaces) {
        requireNoDiffusion(scene, settings.subsurface);
        runHook = [&](std::span<const scenes::HookPoint> points) {
            return engine::hookedSurfaces(*scene.hook, settings.timeSeconds, points, renderer.programs());
        };
    }
    return pictureOf(scene, settings, rowDone, alternatives, std::move(runHook));
}

namespace {

double channelSum(const float* rgba) {
    return double(rgba[0]) + double(rgba[1]) + double(rgba[2]);
}

} // namespace

ShadowFigures ReferencePicture::shadowFigures(const Picture& shown, std::span<const std::uint8_t> excluded) const {
    ShadowFigures figures;
    std::size_t covered = 0, undecided = 0;
    double errors = 0.0, squares = 0.0, variances = 0.0, squaresSpread = 0.0, ofReference = 0.0, light = 0.0;
    for (std::size_t i = 0; i < picture.pixelCount(); ++i) {
        if (picture.covered[i] == 0 || (!excluded.empty() && excluded[i] != 0)) continue;
        ++covered;
        undecided += undecidedShadows[i];
        const reference::Noise& noise = shadowNoise[i];
        if (noise.variance == 0.0) continue;
        const double sum = channelSum(picture.pixel(i)), error = channelSum(shown.pixel(i)) - sum;
        if (!std::isfinite(error)) continue; // counted among bad pixels
        ++figures.noisyPixels;
        light += sum;
        variances += noise.variance;
        ofReference += noise.ofReference;
        squaresSpread += noise.fourth + 2.0 * noise.variance * noise.variance;
        errors += error;
        squares += error * error;
    }
    figures.undecided = covered > 0 ? double(undecided) / double(covered) : 0.0;
    if (figures.noisyPixels == 0) return figures;
    figures.noise = std::sqrt(squares / variances);
    figures.mostNoise = std::sqrt(1.0 + kShadowNoises * std::sqrt(squaresSpread) / variances);
    figures.ofReference = std::sqrt(ofReference / squares);
    figures.bias = errors / light;
    figures.biasNoise = std::sqrt(variances) / light;
    return figures;
}

Picture ReferencePicture::nearestTo(const Picture& shown) const {
    Picture nearest = picture;
    for (std::size_t i = 0; i < nearest.pixelCount(); ++i) {
        const glm::dvec3 seen(shown.pixel(i)[0], shown.pixel(i)[1], shown.pixel(i)[2]);
        if (!std::isfinite(seen.r + seen.g + seen.b)) continue;
        glm::dvec3 own(picture.pixel(i)[0], picture.pixel(i)[1], picture.pixel(i)[2]);
        for (const reference::Span& span : alternatives[i]) {
            const glm::dvec3 other = glm::clamp(seen, span.least, span.most);
            if (glm::distance(other, seen) < glm::distance(own, seen)) own = other;
        }
        for (int c = 0; c < 3; ++c) nearest.rgba[4 * i + std::size_t(c)] = float(own[c]);
    }
    return nearest;
}

Picture ReferencePicture::weighted(Picture truth, const Picture& shown) const {
    for (std::size_t i = 0; i < truth.pixelCount(); ++i) {
        for (int c = 0; c < 3; ++c) {
            float& right = truth.rgba[4 * i + std::size_t(c)];
            const float seen = shown.rgba[4 * i + std::size_t(c)], weight = errorWeights[i][c];
            if (weight != 1.0f && std::isfinite(seen)) right = std::lerp(seen, right, weight);
        }
    }
    return truth;
}

namespace {

/// Whether is(index) holds for a light that shines.
template <typename Is>
bool anyShining(const scenes::Scene& scene, const frame::FrameSettings& settings, const Is& is) {
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (scene.lights[i].enabled && (!settings.soloLight || *settings.soloLight == int(i)) && is(i)) return true;
    return false;
}

/// Whether any light, or with `ofSize` any light with a size, casts shadows.
bool hasShadows(const scenes::Scene& scene, const frame::FrameSettings& settings, bool ofSize) {
    return scenes::hasCasters(scene) && anyShining(scene, settings, [&](std::size_t i) {
               return (!ofSize || scenes::hasSize(scene.lights[i])) && scenes::castsShadow(scene, i, settings.shadows);
           });
}

} // namespace

bool hasTracedShadows(const scenes::Scene& scene, const frame::FrameSettings& settings) {
    return !frame::infoOf(settings.shadowFilter).usesMaps && hasShadows(scene, settings, false);
}

Tolerance referenceTolerance(const scenes::Scene& scene, const frame::FrameSettings& settings) {
    const frame::TextureFilter filter = settings.filter;
    Tolerance tolerance;
    if (frame::infoOf(settings.shadowFilter).usesMaps && hasShadows(scene, settings, false)) {
        tolerance.reason = "shadow maps are an approximation: their error is reported, and held to nothing";
        return tolerance;
    }
    if (frame::isLitByEnvironment(scene, settings)) {
        tolerance.reason = settings.environment.light == frame::EnvironmentLight::Sampled
                               ? "samples of the environment have noise: the error is reported, and held to nothing"
                               : "filtered light of the environment is an approximation: its error is reported, and "
                                 "held to nothing";
        return tolerance;
    }
    const auto isArea = [&](std::size_t i) { return scenes::infoOf(scene.lights[i].type).isArea; };
    if (anyShining(scene, settings, isArea)) {
        tolerance.reason = infoOf(settings.area.lights).usesSamples
                               ? "samples of area lights have noise: the error is reported, and held to nothing"
                               : "transformed cosines approximate lobes under area lights: their error is reported, "
                                 "and held to nothing";
        return tolerance;
    }
    const auto isAny = [used = scenes::materialsInUse(scene)](bool (*isOne)(const scenes::Material&)) {
        return std::ranges::any_of(used, [&](const scenes::Material* material) { return isOne(*material); });
    };
    const auto isOpaque = [](const scenes::Material& material) { return !scenes::isTransparent(material); };
    const auto looksBehind = [](const scenes::Material& material) {
        return scenes::hasBody(material) || frame::mayScatter(material);
    };
    if (infoOf(settings.refraction).showsScene && isAny(looksBehind) && isAny(isOpaque)) {
        tolerance.reason = "bodies and rough sheets of glass show what the picture holds of the surfaces behind them: "
                           "the error is reported, and held to nothing";
        return tolerance;
    }
    if (scenes::anyDiffuses(scene, settings.subsurface)) {
        tolerance.reason =
            "light diffused in texture space is an approximation: its error is reported, and held to nothing";
        return tolerance;
    }
    // Hook outputs vary over a surface in fp32, as textures do.
    const bool isTextured = frame::materialFeatures(scene).textures() || (scene.hook && scene.hook->changesSurfaces);
    if (!isTextured) {
        tolerance.p999Rel = 3e-4;
        tolerance.relMse = 1e-8;
        tolerance.bias = 1e-4;
        tolerance.reason =
            "fp32 lighting of the same surface: rounding of n, l and v, multiplied by a highlight's slope";
    } else if (filter == frame::TextureFilter::Exact) {
        tolerance.p999Rel = 1e-3;
        tolerance.relMse = 1e-6;
        tolerance.bias = 1e-4;
        tolerance.reason = "fp32 lighting and texture coordinates, whose rounding moves bilinear weights and normals";
    } else {
        tolerance.p999Rel = 0.2;
        tolerance.relMse = 1e-4;
        tolerance.bias = 5e-3;
        tolerance.reason =
            "the reference takes the nearest of the values that OpenGL allows a filter, but a highlight may "
            "peak between them, and each level stored in 8 bits rounds once more. Set by measurement: "
            "in built-in scenes the error is at most 0.11 in 99.9 % of the pixels, and relMse 7.0e-5";
    }
    if (isAny(frame::mayPassByLobe)) {
        tolerance.p999Rel = std::max(tolerance.p999Rel.value(), 6e-3);
        tolerance.relMse = std::max(tolerance.relMse.value(), 1e-6);
        tolerance.bias = std::max(tolerance.bias.value(), 5e-4);
        tolerance.reason +=
            "; what rough glass lets pass is interpolated in a table of lobes, to 4e-4 of the light; where "
            "less than an eighth passes, errors of its pixels count in parts of an eighth";
    }
    const auto passesByTwoAlphas = [](const scenes::Material& material) {
        return scenes::isTransmissive(material) && scenes::isAnisotropic(material);
    };
    if (isAny(passesByTwoAlphas)) {
        // Computed numerically for all alphas from 0.01 and an F0 of 0.04: relMse 2.1e-5, bias 2.8e-3, and 1.2e-2 of
        // the light.
        const auto reflectsMuch = [](const scenes::Material& material) {
            return scenes::isTransmissive(material) && scenes::isAnisotropic(material) &&
                   (material.metallic > 0.0f || !(material.ior >= 1.0f && material.ior <= 2.0f));
        };
        if (isAny(reflectsMuch))
            return {.reason = "24 facets stand for the lobe of anisotropic glass: where it reflects "
                              "much, the error is reported, and held to nothing"};
        tolerance.p999Rel = std::max(tolerance.p999Rel.value(), 3e-2);
        tolerance.relMse = std::max(tolerance.relMse.value(), 4e-5);
        tolerance.bias = std::max(tolerance.bias.value(), 5e-3);
        tolerance.reason += "; what anisotropic glass lets pass is that of 24 facets of its lobe";
    }
    if (hasShadows(scene, settings, true)) {
        tolerance.relMse = std::max(tolerance.relMse.value(), 1e-5);
        tolerance.reason +=
            "; the noise of a few rays to each light with a size is allowed a pixel within five standard deviations "
            "and two rays, but where the reference's 1024 rays all agree, and is judged over all pixels besides";
    }
    return tolerance;
}

} // namespace tessera::validation
