#pragma once
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Scene.h"

namespace tessera::frame {

/// Extents of one mesh instance.
struct SurfaceBounds {
    scenes::Box3 boxWS;         ///< bounds of the vertices used by triangles
    double reachMetres = 0.0;   ///< distance of the box's farthest corner from the node's origin
    glm::dvec3 nodeWS{0.0};     ///< the node's origin
    double longestMetres = 0.0; ///< longest edge
    std::size_t triangles = 0;
    double usualMetres = 0.0;       ///< median distance of the corners from their median; ignores outliers
    double textureSideMetres = 0.0; ///< per unit of the first texture coordinates, from areas; 0: no area
    int instance = 0;               ///< place among the mesh instances of all nodes, in document order
};

/// Bounds of everything drawn, one per mesh instance with triangles.
std::vector<SurfaceBounds> surfaceBounds(const scenes::Scene& scene);

/// SurfaceBounds::usualMetres of the mesh instance with the most triangles; 0 where nothing is drawn.
double usualMetres(std::span<const SurfaceBounds> bounds);

/// The range of view depths that depth values cover, 1 at the near end and 0 at the far end, and the position of
/// lighting space's origin on the view axis. fp32 has a relative step of 6e-8, so depth and positions keep more digits
/// with a shorter interval and a nearer origin. Nothing visible lies outside the interval.
struct DepthInterval {
    double nearMetres = 0.0;
    double farMetres = 0.0; ///< may be infinite for a perspective camera
    double originMetres = 0.0;
    /// Whether depth is linear in the distance, or nearly so: the far end is at most twice as far as the near end.
    bool isEven = false;
};

/// The shortest interval that covers the visible part of `bounds`. `halfExtent` is half the image plane in metres, at
/// unit distance from the eye or (orthographic) at any distance. Returns the camera's near and far distance, with the
/// origin at the eye, if nothing is visible or if a perspective camera sees depths over more than a factor of two,
/// where reverse-Z is precise at each distance. An orthographic camera without a far plane then ends a thousand image
/// heights away.
DepthInterval depthInterval(const scenes::Camera& camera, const glm::dvec2& halfExtent,
                            std::span<const SurfaceBounds> bounds);

} // namespace tessera::frame
