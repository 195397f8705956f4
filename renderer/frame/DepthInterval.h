#pragma once
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Scene.h"

namespace tessera::frame {

/// Where the vertices of one mesh instance lie.
struct SurfaceBounds {
    scenes::Box3 boxWS;         ///< of the vertices that triangles use
    double reachMetres = 0.0;   ///< of the box's farthest corner from the node's origin
    glm::dvec3 nodeWS{0.0};     ///< the node's origin
    double longestMetres = 0.0; ///< of the edges
    std::size_t triangles = 0;
    double usualMetres = 0.0;       ///< the median of the corners' distances from their median: without strays
    double textureSideMetres = 0.0; ///< that a side of the first texture coordinates covers, by areas; 0: no area
    int instance = 0;               ///< place among the mesh instances of all nodes, in document order
};

/// Bounds of everything drawn, one per mesh instance with triangles.
std::vector<SurfaceBounds> surfaceBounds(const scenes::Scene& scene);

/// SurfaceBounds::usualMetres of the mesh instance with the most triangles; 0 where nothing is drawn.
double usualMetres(std::span<const SurfaceBounds> bounds);

/// The view depths that depth values stand for, 1 at the near end and 0 at the far one, and where on the view axis
/// lighting space has its origin. fp32 has steps of 6e-8 of a number, so depth and positions keep the more digits the
/// shorter the interval and the nearer the origin. Nothing visible lies outside the interval.
struct DepthInterval {
    double nearMetres = 0.0;
    double farMetres = 0.0; ///< may be infinite for a perspective camera
    double originMetres = 0.0;
    /// Whether depth is even in the distance or nearly so: the far end is at most twice as far as the near one.
    bool isEven = false;
};

/// The shortest interval that holds what the camera may see of `bounds`. `halfExtent` is the picture's, in
/// metres a metre ahead of the eye, or (orthographic) anywhere. It is the camera's own, with the origin at the eye,
/// where a perspective camera stands so close that its depths are spread over more than a factor of two: there
/// reverse-Z has digits for each distance. Without bounds it is the camera's own too. An orthographic camera without a
/// far plane that sees nothing ends a thousand picture heights away.
DepthInterval depthInterval(const scenes::Camera& camera, const glm::dvec2& halfExtent,
                            std::span<const SurfaceBounds> bounds);

} // namespace tessera::frame
