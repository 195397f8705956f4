#include "viewer/camera/FrameBounds.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tessera::viewer {
namespace {

constexpr double kMargin = 1.05; ///< keeps a margin to the image's edges

scenes::Box3 framedBox(const scenes::Box3& boundsWS) {
    const bool hasSize = !boundsWS.empty() && glm::length(boundsWS.max - boundsWS.min) > 0.0;
    if (hasSize) return boundsWS;
    const glm::dvec3 centerWS = boundsWS.empty() ? glm::dvec3(0.0) : boundsWS.min;
    return {centerWS - 1.0 / std::sqrt(3.0), centerWS + 1.0 / std::sqrt(3.0)};
}

/// Extent of a box's corners in view.
struct Reach {
    double distanceMetres = 0.0;   ///< perspective: from the centre to the nearest eye with every corner in view
    double halfHeightMetres = 0.0; ///< orthographic: of the smallest image with every corner
    double depthMetres = 0.0;      ///< of the farthest corner beyond the centre
};

Reach reachOf(const scenes::Box3& box, const Heading& heading, const glm::dvec2& tanHalf, double aspect) {
    const glm::dvec3 halfWS = 0.5 * (box.max - box.min);
    const glm::dvec3 rightWS = heading.rightWS(), upWS = heading.upWS(), forwardWS = heading.forwardWS();
    Reach reach;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 signs(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
        const glm::dvec3 fromCenterWS = signs * halfWS;
        const double x = std::abs(glm::dot(fromCenterWS, rightWS));
        const double y = std::abs(glm::dot(fromCenterWS, upWS));
        const double depth = glm::dot(fromCenterWS, forwardWS);
        reach.distanceMetres = std::max({reach.distanceMetres, x / tanHalf.x - depth, y / tanHalf.y - depth});
        reach.halfHeightMetres = std::max({reach.halfHeightMetres, y, x / aspect});
        reach.depthMetres = std::max(reach.depthMetres, depth);
    }
    return reach;
}

} // namespace

CameraPose frameBounds(const scenes::Box3& boundsWS, const CameraPose& pose, const scenes::Camera& lens,
                       double aspect) {
    assert(aspect > 0.0);
    const scenes::Box3 box = framedBox(boundsWS);
    const glm::dvec3 centerWS = 0.5 * (box.min + box.max);
    const double diagonalMetres = glm::length(box.max - box.min);
    const bool isPerspective = lens.projection == scenes::Projection::Perspective;
    const double tanHalf = std::tan(0.5 * lens.fovYRadians) / kMargin;
    const Reach reach = reachOf(box, pose.heading, {tanHalf * aspect, tanHalf}, aspect);

    // Keeps the eye out of boxes that are flat or thin along the view: this fraction of the diagonal stays free.
    constexpr double kLeastShare = 0.05;
    const double leastMetres = reach.depthMetres + kLeastShare * diagonalMetres; // the box is symmetric
    CameraPose framed = pose;
    framed.focusMetres = isPerspective ? std::max(reach.distanceMetres, leastMetres) : leastMetres;
    framed.eyeWS = centerWS - framed.focusMetres * pose.heading.forwardWS();
    framed.halfHeightMetres = std::max(kMargin * reach.halfHeightMetres, kLeastShare * diagonalMetres);

    const double nearestMetres = framed.focusMetres - reach.depthMetres;
    const double farthestMetres = framed.focusMetres + reach.depthMetres;
    framed.nearMetres = std::min(pose.nearMetres, 0.5 * nearestMetres);
    framed.farMetres = std::max(pose.farMetres, kMargin * farthestMetres);
    return framed;
}

} // namespace tessera::viewer
