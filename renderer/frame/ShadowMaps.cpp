#include "renderer/frame/ShadowMaps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/frame/CasterTree.h"
#include "renderer/frame/LightRange.h"

namespace tessera::frame {

namespace {

/// A light and the extents that its faces are planned from.
struct Wanted {
    scenes::Light light; ///< at the frame's time
    double reachMetres = 0.0;
    std::optional<ShadowCone> cone;
};

/// Pixels in range of a light, and the largest width of a face's far end in the image: as seen from the nearest point
/// in range, but from no nearer than a quarter of the range.
ShadowDemand demandOf(const Wanted& wanted, const CameraView& view, const FrameSettings& settings, const Ball& scene) {
    const glm::ivec2 whole = settings.wholePixels.value_or(settings.sizePixels);
    const double side = double(std::max(whole.x, whole.y));
    const double all = double(whole.x) * double(whole.y);
    const bool isPlaced = scenes::infoOf(wanted.light.type).hasPosition();
    ShadowDemand demand{isPlaced ? wanted.cone ? 1 : kAxisFaces : settings.shadowMaps.cascades, 0, side, all};
    const auto sized = [&] {
        demand.wantedTexels = settings.shadowMaps.resolutionTexels.value_or(automaticSideTexels(demand.pictureTexels));
        return demand;
    };
    if (!isPlaced) return sized();
    const double reach = std::min(wanted.reachMetres, 2.0 * scene.radiusMetres);
    const double distance = glm::distance(wanted.light.positionWS, view.eyeWS);
    const double fromEye =
        std::max(distance - wanted.reachMetres, glm::distance(scene.centreWS, view.eyeWS) - scene.radiusMetres);
    // At unit distance (perspective) or at any distance (orthographic).
    const double metresPerPixel =
        double(view.constants.rayFromPixel.y) * double(settings.sizePixels.y) / double(whole.y);
    const bool isParallel = view.constants.forwardLS.w != 0.0f;
    const double pixelMetres = isParallel ? metresPerPixel : std::max(fromEye, 0.25 * reach) * metresPerPixel;
    const double widthMetres =
        std::min(2.0 * wanted.reachMetres * (wanted.cone ? wanted.cone->tangent : 1.0), 2.0 * scene.radiusMetres);
    if (pixelMetres > 0.0) demand.pictureTexels = std::min(widthMetres / pixelMetres, side);
    // Surfaces in range lie within both the light's sphere and the scene's: they cover at most the smaller disk.
    const auto diskPixels = [&](double metres, double radius) {
        const double ahead = isParallel ? 1.0 : std::sqrt(std::max((metres - radius) * (metres + radius), 0.0));
        const double radiusPixels = radius / std::max(ahead * metresPerPixel, 1e-30);
        return std::numbers::pi * radiusPixels * radiusPixels;
    };
    demand.pixels = std::min({diskPixels(distance, wanted.reachMetres),
                              diskPixels(glm::distance(scene.centreWS, view.eyeWS), scene.radiusMetres), all});
    return sized();
}

/// Rounding error in metres of a surface relative to a light's faces, without the part proportional to the surface's
/// distance from the origin of lighting space. A vertex is the sum of its node's position and its offset from the node.
/// Either the node is near, or the whole mesh is as far away as the node, less the mesh's extent.
double roundingMetres(const ShadowMaps& maps, const ShadowedLight& light, const CameraView& view,
                      std::span<const SurfaceBounds> bounds) {
    double objectMetres = 0.0;
    for (const SurfaceBounds& one : bounds) {
        const double nodeMetres = std::min(glm::distance(one.nodeWS, view.originWS), one.reachMetres);
        objectMetres = std::max(objectMetres, 2.0 * nodeMetres + one.longestMetres);
    }
    double faceMetres = 0.0; // the faces of a directional light have different origins
    for (std::size_t i = light.firstFace; i < light.firstFace + std::size_t(light.faces); ++i)
        faceMetres =
            std::max(faceMetres, glm::distance(glm::dvec3(maps.faces[i].camera.worldFromCamera[3]), view.originWS));
    return kPositionRounding * (objectMetres + faceMetres + double(view.constants.depthKey.y));
}

} // namespace

std::size_t ShadowMaps::reduced() const {
    return std::size_t(std::ranges::count_if(
        lights, [](const ShadowedLight& l) { return l.sideTexels > 0 && l.sideTexels < l.wantedTexels; }));
}

std::size_t ShadowMaps::useless() const {
    return std::size_t(std::ranges::count_if(
        lights, [&](const ShadowedLight& l) { return l.sideTexels > 0 && l.errorMetres > usualMetres; }));
}

std::size_t ShadowMaps::unmapped() const {
    return std::size_t(std::ranges::count(lights, 0, &ShadowedLight::sideTexels));
}

std::string shadowFaceName(int i, int faces) {
    constexpr const char* kAxes[kAxisFaces] = {"+x", "-x", "+y", "-y", "+z", "-z"};
    if (faces == 1) return "only map";
    return faces == kAxisFaces ? kAxes[i] : "cascade " + std::to_string(i + 1) + (i == 0 ? " (nearest)" : "");
}

int shadowTapTexels(const FrameSettings& settings) {
    // Half of the square, and a texel for taps between texels.
    return infoOf(settings.shadowFilter).usesWidth ? settings.shadowMaps.widthTexels / 2 + 2 : 1;
}

int shadowBorderTexels(const FrameSettings& settings, const scenes::Light& light, int sideTexels) {
    return int(shared::shadowBorderTexels(float(sideTexels), float(shadowTapTexels(settings)),
                                          infoOf(settings.shadowFilter).usesSizes && scenes::hasSize(light)));
}

ShadowMaps makeShadowMaps(const scenes::Scene& scene, const PackedLights& lights, const CameraView& view,
                          const FrameSettings& settings, std::span<const SurfaceBounds> bounds) {
    const Ball all = ballAround(bounds);
    ShadowMaps maps;
    std::vector<Wanted> wanted; // parallel to maps.lights
    std::vector<ShadowDemand> demands;
    for (std::size_t i = 0; i < lights.texels.size(); ++i) {
        if ((int(lights.texels[i].color.w) & LIGHT_SHADOWED) == 0) continue;
        Wanted own;
        own.light = lightAtTime(scene.lights[std::size_t(lights.sceneIndex[i])], settings.timeSeconds);
        if (scenes::infoOf(own.light.type).hasPosition()) {
            const double farthestMetres = glm::distance(own.light.positionWS, all.centreWS) + all.radiusMetres;
            own.reachMetres = std::max(std::min(reachMetres(own.light, settings.rangeTolerance), farthestMetres), 1e-9);
            own.cone = shadowConeOf(own.light, all);
        }
        const ShadowDemand& demand = demands.emplace_back(demandOf(own, view, settings, all));
        maps.lights.push_back({i, 0, demand.faces, demand.wantedTexels, 0});
        wanted.push_back(own);
    }
    const std::vector<int> gotTexels = fitBudget(demands, settings.shadowMaps.budgetMiB * 1024.0 * 1024.0);
    std::vector<int> sides;
    const double cameraNear = scene.cameras[std::size_t(settings.camera)].nearMetres;
    for (std::size_t i = 0; i < maps.lights.size(); ++i) {
        ShadowedLight& light = maps.lights[i];
        light.firstFace = maps.faces.size();
        light.sideTexels = gotTexels[i];
        if (light.sideTexels == 0) continue;
        const scenes::Light& shining = wanted[i].light;
        const int border = shadowBorderTexels(settings, shining, light.sideTexels);
        std::vector<scenes::Camera> cameras =
            scenes::infoOf(shining.type).hasPosition()
                ? placedCameras(shining.positionWS, wanted[i].cone, wanted[i].reachMetres, light.sideTexels, border)
                : cascadeCameras(shining.directionWS, light.faces, all, view,
                                 settings.wholePixels.value_or(settings.sizePixels), cameraNear, light.sideTexels,
                                 border);
        for (scenes::Camera& camera : cameras) {
            ShadowFace& face = maps.faces.emplace_back(ShadowFace{std::move(camera), glm::ivec2(0), light.sideTexels});
            // Views of shadows show them beyond the light's range too.
            const bool isCut = scenes::infoOf(shining.type).hasPosition() && !showsShadowsOfOne(settings.view) &&
                               !showsMaps(settings.view);
            if (isCut) face.reachMetres = wanted[i].reachMetres;
            sides.push_back(light.sideTexels);
        }
        const scenes::Camera& nearest = maps.faces[light.firstFace].camera;
        light.errorMetres = roundingMetres(maps, light, view, bounds);
        if (nearest.projection == scenes::Projection::Orthographic)
            light.errorMetres = std::max(light.errorMetres, 2.0 * nearest.halfHeightMetres / double(light.sideTexels));
    }
    maps.usualMetres = usualMetres(bounds);
    std::vector<glm::ivec2> corners;
    // At least one texel, even if no light has a face.
    maps.atlasTexels = glm::max(placeFaces(sides, corners), glm::ivec2(1));
    for (std::size_t i = 0; i < maps.faces.size(); ++i) maps.faces[i].cornerTexels = corners[i];
    return maps;
}

CameraView faceView(const ShadowFace& face) {
    CameraView view = makeCameraView(face.camera, glm::ivec2(face.sideTexels), LightingSpace::World, glm::vec3(0.0f));
    // Pixel coordinates are those of the atlas.
    view.constants.rayFromPixel.z += float(face.cornerTexels.x);
    view.constants.rayFromPixel.w += float(face.cornerTexels.y);
    return view;
}

std::vector<shared::ShadowFaceTexels> packFaces(const ShadowMaps& maps, const CameraView& view, std::size_t firstTexel,
                                                std::span<const SurfaceBounds> bounds, PackedLights& lights) {
    for (const ShadowedLight& light : maps.lights) {
        glm::vec4& texel = lights.shadows[light.light].shadow;
        if (light.sideTexels == 0) {
            lights.texels[light.light].color.w -= float(LIGHT_SHADOWED);
            continue;
        }
        texel.z = float(firstTexel + light.firstFace * SHADOW_FACE_TEXELS);
        texel.w = float(roundingMetres(maps, light, view, bounds));
        if (light.faces == kAxisFaces) lights.texels[light.light].color.w += float(LIGHT_SIX_FACES);
    }
    std::vector<shared::ShadowFaceTexels> packed;
    for (const ShadowFace& face : maps.faces) {
        const scenes::Camera& camera = face.camera;
        const bool isParallel = camera.projection == scenes::Projection::Orthographic;
        const double half = isParallel ? camera.halfHeightMetres : std::tan(0.5 * camera.fovYRadians);
        const glm::dvec3 fromOrigin = view.originWS - glm::dvec3(camera.worldFromCamera[3]);
        const auto row = [&](const glm::dvec3& axis) { return glm::vec4(axis, glm::dot(axis, fromOrigin)); };
        const float halfTexels = 0.5f * float(face.sideTexels);
        packed.push_back({row(glm::dvec3(camera.worldFromCamera[0]) / half),
                          row(glm::dvec3(camera.worldFromCamera[1]) / half),
                          row(-glm::dvec3(camera.worldFromCamera[2])),
                          glm::vec4(glm::vec2(face.cornerTexels) + halfTexels, halfTexels,
                                    isParallel ? float(-1.0 / camera.farMetres) : float(camera.nearMetres))});
    }
    return packed;
}

} // namespace tessera::frame
