#pragma once
#include <optional>
#include <span>
#include <vector>

#include "renderer/frame/CameraView.h"
#include "renderer/frame/DepthInterval.h"
#include "renderer/frame/FrameSettings.h"

/// Where the faces of a light's shadow map look from, and how far to each side. A face's picture is `sideTexels` wide;
/// points are looked up in it but for `borderTexels` at its rim.
namespace tessera::frame {

struct Ball {
    glm::dvec3 centreWS{0.0};
    double radiusMetres = 0.0;
};
/// Around the middle of the boxes.
Ball ballAround(std::span<const SurfaceBounds> bounds);

/// A face that holds all that a light with a place reaches.
struct ShadowCone {
    glm::dvec3 forwardWS{0.0};
    double tangent = 1.0; ///< of its half angle
};
/// The cone of a spot light, or the narrower one around all that is drawn, seen from beside it. Without one, the light
/// takes six faces.
std::optional<ShadowCone> shadowConeOf(const scenes::Light& light, const Ball& scene);

/// Faces of a light for each direction of the axes. Cascades are fewer.
inline constexpr int kAxisFaces = 6;
static_assert(kMostShadowCascades < kAxisFaces);

/// The near end of a perspective face as a share of what its light reaches. Reverse-Z keeps the digits of any distance.
inline constexpr double kFaceNearShare = 0x1p-40;

/// Of a light with a place: one along the cone, or six along the axes: +x, -x, +y, -y, +z, -z.
std::vector<scenes::Camera> placedCameras(const glm::dvec3& lightWS, const std::optional<ShadowCone>& cone,
                                          double reachMetres, int sideTexels, int borderTexels);

/// Of a directional light: `count` cascades, the nearest one first. `nearMetres` is the view's camera's. Each is a
/// square around a sphere, so that it does not change as the camera turns, and its middle lies on whole texels of a
/// grid that is fixed in the world, so that it does not as the camera moves.
std::vector<scenes::Camera> cascadeCameras(const glm::dvec3& directionWS, int count, const Ball& scene,
                                           const CameraView& view, const glm::ivec2& sizePixels, double nearMetres,
                                           int sideTexels, int borderTexels);

} // namespace tessera::frame
