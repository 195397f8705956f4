#pragma once
#include <optional>
#include <span>
#include <vector>

#include "renderer/frame/CameraView.h"
#include "renderer/frame/DepthInterval.h"
#include "renderer/frame/FrameSettings.h"

/// Cameras of the faces of a light's shadow map. A face's image is `sideTexels` wide; lookups stay out of its border of
/// `borderTexels`.
namespace tessera::frame {

struct Ball {
    glm::dvec3 centreWS{0.0};
    double radiusMetres = 0.0;
};
/// Bounding sphere of all boxes, around the centre of their union.
Ball ballAround(std::span<const SurfaceBounds> bounds);

/// The cone of a single face that covers the range of a light with a position.
struct ShadowCone {
    glm::dvec3 forwardWS{0.0};
    double tangent = 1.0; ///< of its half angle
};
/// The cone of a spot light, or a narrower one around the scene if the light is outside it. None: the light needs six
/// faces.
std::optional<ShadowCone> shadowConeOf(const scenes::Light& light, const Ball& scene);

/// Faces of a light along the axes, as in a cube map. Cascades are fewer.
inline constexpr int kAxisFaces = 6;
static_assert(kMostShadowCascades < kAxisFaces);

/// The near plane of a perspective face as a fraction of the light's range. Reverse-Z is precise at any distance.
inline constexpr double kFaceNearShare = 0x1p-40;

/// Cameras of a light with a position: one along the cone, or six along the axes: +x, -x, +y, -y, +z, -z.
std::vector<scenes::Camera> placedCameras(const glm::dvec3& lightWS, const std::optional<ShadowCone>& cone,
                                          double reachMetres, int sideTexels, int borderTexels);

/// Cameras of a directional light: `count` cascades, the nearest first. `nearMetres` is the near distance of the view's
/// camera. Each cascade is a square around a sphere, so that it does not change as the camera rotates. Its centre is
/// snapped to whole texels of a grid fixed in the world, so that texels do not shift as the camera moves.
std::vector<scenes::Camera> cascadeCameras(const glm::dvec3& directionWS, int count, const Ball& scene,
                                           const CameraView& view, const glm::ivec2& sizePixels, double nearMetres,
                                           int sideTexels, int borderTexels);

} // namespace tessera::frame
