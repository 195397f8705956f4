#include "renderer/frame/ShadowCameras.h"

#include <algorithm>
#include <cmath>

namespace tessera::frame {

namespace {

/// Widest half angle of a spot light with a single face: its tangent is 2.7, so texels at the rim are 8 times as large
/// as at the centre. Wider cones use six faces, like point lights.
constexpr double kMostSpotRadians = 1.22;
/// Enlarges the scene's bounding sphere for rounding.
constexpr double kSceneRoom = 1.001;
/// Blend between uniform (0) and logarithmic (1) cascade splits: Zhang et al. 2006, "Parallel-split shadow maps".
constexpr double kSplitByRatio = 0.8;
/// Least start of the splits as a fraction of the farthest depth: nearer ones give cascades of millimetres.
constexpr double kNearestSplit = 0.01;
/// Cascade lengths are rounded to powers of this ratio, so that a moving camera does not change their texels.
constexpr double kStep = 1.189207115002721; // 2^(1/4)

double steppedUp(double metres) {
    return metres > 0.0 ? std::pow(kStep, std::ceil(std::log(metres) / std::log(kStep) - 1e-9)) : 0.0;
}

double steppedDown(double metres) {
    return metres > 0.0 ? std::pow(kStep, std::floor(std::log(metres) / std::log(kStep) + 1e-9)) : 0.0;
}

/// A camera that looks along `forwardWS`, with `upWS` up as far as that is possible.
scenes::Camera lookingAlong(const glm::dvec3& fromWS, const glm::dvec3& forwardWS, const glm::dvec3& upWS) {
    const glm::dvec3 right = glm::normalize(glm::cross(forwardWS, upWS));
    scenes::Camera camera;
    camera.worldFromCamera = {glm::dvec4(right, 0.0), glm::dvec4(glm::cross(right, forwardWS), 0.0),
                              glm::dvec4(-forwardWS, 0.0), glm::dvec4(fromWS, 1.0)};
    return camera;
}

/// The coordinate axis farthest from a direction.
glm::dvec3 axisAcross(const glm::dvec3& directionWS) {
    const glm::dvec3 size = glm::abs(directionWS);
    return size.x <= size.y && size.x <= size.z ? glm::dvec3(1.0, 0.0, 0.0)
           : size.y <= size.z                   ? glm::dvec3(0.0, 1.0, 0.0)
                                                : glm::dvec3(0.0, 0.0, 1.0);
}

// ---- Lights with a position ----

/// Sets the field of view so that `borderTexels` surround the part of the image with half width `tangent`.
void setLens(scenes::Camera& camera, double tangent, int sideTexels, int borderTexels) {
    const double within = std::max(1.0 - 2.0 * borderTexels / double(sideTexels), 0.25);
    camera.fovYRadians = 2.0 * std::atan(tangent / within);
}

// ---- Cascades ----

/// View depths [near, far] that the cascades divide.
struct Slices {
    double nearMetres = 0.0, farMetres = 0.0;

    double split(int i, int count) const {
        const double first = std::max(nearMetres, kNearestSplit * farMetres), share = double(i) / double(count);
        if (i == 0) return nearMetres;
        return kSplitByRatio * first * std::pow(farMetres / first, share) +
               (1.0 - kSplitByRatio) * (first + (farMetres - first) * share);
    }
};

Slices slicesOf(const CameraView& view, const Ball& scene, double nearMetres) {
    const glm::dvec3 forwardWS = glm::transpose(view.lsFromWorld) * view.forwardLS;
    const double middle = glm::dot(forwardWS, scene.centreWS - view.eyeWS);
    Slices slices;
    slices.nearMetres = std::max(steppedDown(middle - scene.radiusMetres), nearMetres);
    slices.farMetres = std::max(steppedUp(middle + scene.radiusMetres), slices.nearMetres * kStep);
    if (!(slices.farMetres > 0.0)) slices.farMetres = 1.0;
    return slices;
}

/// Bounding sphere of the view frustum between two depths.
Ball ballAround(const CameraView& view, const glm::ivec2& sizePixels, double nearMetres, double farMetres) {
    const glm::dvec3 forwardWS = glm::transpose(view.lsFromWorld) * view.forwardLS;
    const double halfDiagonal = 0.5 * glm::length(glm::dvec2(sizePixels) * glm::dvec2(view.constants.rayFromPixel));
    const bool isParallel = view.constants.forwardLS.w != 0.0f;
    if (isParallel)
        return {view.eyeWS + 0.5 * (nearMetres + farMetres) * forwardWS,
                glm::length(glm::dvec2(halfDiagonal, 0.5 * (farMetres - nearMetres)))};
    // Centre at equal distances from the near and the far corners, but no farther than the far end.
    const double middle = std::min(0.5 * (nearMetres + farMetres) * (1.0 + halfDiagonal * halfDiagonal), farMetres);
    return {view.eyeWS + middle * forwardWS, glm::length(glm::dvec2(farMetres - middle, halfDiagonal * farMetres))};
}

} // namespace

Ball ballAround(std::span<const SurfaceBounds> bounds) {
    scenes::Box3 box;
    for (const SurfaceBounds& one : bounds) {
        box.extend(one.boxWS.min);
        box.extend(one.boxWS.max);
    }
    if (box.empty()) return {};
    return {0.5 * (box.min + box.max), 0.5 * glm::length(box.max - box.min)};
}

std::optional<ShadowCone> shadowConeOf(const scenes::Light& light, const Ball& scene) {
    std::optional<ShadowCone> cone;
    const double widest = std::tan(kMostSpotRadians);
    if (scenes::infoOf(light.type).reach == scenes::LightReach::Cone &&
        double(light.outerConeRadians) < kMostSpotRadians)
        cone = {glm::normalize(light.directionWS), std::tan(std::max(double(light.outerConeRadians), 1e-3))};
    const glm::dvec3 toScene = scene.centreWS - light.positionWS;
    const double metres = glm::length(toScene), radius = kSceneRoom * scene.radiusMetres;
    if (!(metres > radius)) return cone;
    const double tangent = radius / std::sqrt((metres - radius) * (metres + radius));
    if (tangent < (cone ? cone->tangent : widest)) cone = {toScene / metres, tangent};
    return cone;
}

std::vector<scenes::Camera> placedCameras(const glm::dvec3& lightWS, const std::optional<ShadowCone>& cone,
                                          double reachMetres, int sideTexels, int borderTexels) {
    std::vector<scenes::Camera> cameras;
    const auto add = [&](const glm::dvec3& forwardWS, const glm::dvec3& upWS, double tangent) {
        scenes::Camera camera = lookingAlong(lightWS, forwardWS, upWS);
        camera.nearMetres = kFaceNearShare * reachMetres;
        setLens(camera, tangent, sideTexels, borderTexels);
        cameras.push_back(camera);
    };
    if (cone) {
        add(cone->forwardWS, axisAcross(cone->forwardWS), cone->tangent);
        return cameras;
    }
    // +x, -x, +y, -y, +z, -z, as lib/shadow/shadow_map.glsl numbers them.
    for (int face = 0; face < kAxisFaces; ++face) {
        glm::dvec3 forwardWS(0.0);
        forwardWS[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
        glm::dvec3 upWS(0.0);
        upWS[(face / 2 + 1) % 3] = 1.0;
        add(forwardWS, upWS, 1.0);
    }
    return cameras;
}

std::vector<scenes::Camera> cascadeCameras(const glm::dvec3& directionWS, int count, const Ball& scene,
                                           const CameraView& view, const glm::ivec2& sizePixels, double nearMetres,
                                           int sideTexels, int borderTexels) {
    std::vector<scenes::Camera> cameras;
    const glm::dvec3 travelWS = glm::normalize(directionWS);
    const Slices slices = slicesOf(view, scene, nearMetres);
    for (int i = 0; i < count; ++i) {
        Ball seen = ballAround(view, sizePixels, slices.split(i, count), slices.split(i + 1, count));
        if (!(seen.radiusMetres < scene.radiusMetres)) seen = scene;
        seen.radiusMetres = std::max(steppedUp(seen.radiusMetres), 1e-9);
        // One more texel, since snapping moves the centre by up to one.
        const double within = std::max(1.0 - 2.0 * (borderTexels + 1) / double(sideTexels), 0.25);
        const double halfMetres = seen.radiusMetres / within;
        const double texelMetres = 2.0 * halfMetres / double(sideTexels);
        scenes::Camera camera = lookingAlong(glm::dvec3(0.0), travelWS, axisAcross(travelWS));
        const glm::dvec3 right(camera.worldFromCamera[0]), up(camera.worldFromCamera[1]);
        const auto onGrid = [&](const glm::dvec3& axis) {
            return std::floor(glm::dot(axis, seen.centreWS) / texelMetres) * texelMetres;
        };
        // All casters lie ahead.
        const double halfDepthMetres = std::max(kSceneRoom * scene.radiusMetres, 1e-9);
        const double nearAlong = glm::dot(travelWS, scene.centreWS) - halfDepthMetres;
        camera.worldFromCamera[3] = glm::dvec4(onGrid(right) * right + onGrid(up) * up + nearAlong * travelWS, 1.0);
        camera.projection = scenes::Projection::Orthographic;
        camera.halfHeightMetres = halfMetres;
        camera.nearMetres = 0.0;
        camera.farMetres = 2.0 * halfDepthMetres;
        cameras.push_back(camera);
    }
    return cameras;
}

} // namespace tessera::frame
