#include "scenes/Framing.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "base/Error.h"
#include "scenes/Clips.h"
#include "scenes/Corners.h"
#include "scenes/LookAt.h"
#include "scenes/Pose.h"

namespace tessera::scenes {
namespace {

constexpr double kMargin = 1.05; ///< keeps the scene off the image's edge
/// Scenes thinner than this fraction of their second-largest side are flat: viewed from the side they would be a line.
constexpr double kFlatShare = 0.05;
/// Scenes with less depth than this fraction of their larger side are viewed from the front, 7 degrees from above, to
/// make labels of panels legible. Measured: panels of renderer test models 0.08 to 0.34, real objects 0.52 and more.
constexpr double kPanelShare = 0.35;
/// Minimum distance from the eye to the scene, as a fraction of the bounds' diagonal, for scenes thin along the view.
constexpr double kLeastShare = 0.05;

/// Calls `look` for the scene in sampled poses over the length of the active clips, else once as it is.
template <typename Look>
void overClips(Scene& scene, const Look& look) {
    constexpr int kSteps = 16; // samples a turn of 360 degrees every 22.5
    const double seconds = playingSeconds(scene.rig);
    if (!(seconds > 0.0)) return look(scene);
    for (int step = 0; step <= kSteps; ++step) {
        try {
            poseScene(scene, seconds * step / kSteps);
        } catch (const InputError&) { // reported when that time is displayed
            continue;
        }
        look(scene);
    }
    poseScene(scene, 0.0);
}

/// The axis along which the bounds are flat, or -1.
int flatAxis(const glm::dvec3& sides) {
    int thin = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (sides[axis] < sides[thin]) thin = axis;
    const double second = std::min(sides[(thin + 1) % 3], sides[(thin + 2) % 3]);
    return second > 0.0 && sides[thin] < kFlatShare * second ? thin : -1;
}

/// Direction from the scene to the eye.
glm::dvec3 towardsEyeWS(const Scene& scene, const glm::dvec3& sides) {
    const int axis = flatAxis(sides);
    if (axis < 0 && sides.z > 0.0 && sides.z < kPanelShare * std::max(sides.x, sides.y))
        return glm::normalize(glm::dvec3(0.0, 0.13, 1.0));
    if (axis < 0) return glm::normalize(glm::dvec3(1.0, 0.7, 1.0));
    double facing = 0.0; // twice the area facing the positive side minus that facing the negative
    glm::dvec3 corners[3];
    int corner = 0;
    forEachCornerWS(scene, [&](const glm::dvec3& positionWS) {
        corners[corner] = positionWS;
        corner = (corner + 1) % 3;
        if (corner == 0) facing += glm::cross(corners[1] - corners[0], corners[2] - corners[0])[axis];
    });
    glm::dvec3 back(0.0);
    back[axis] = facing < 0.0 ? -1.0 : 1.0;
    return back;
}

/// Constraints on an eye that looks along an axis: for each side of the image the most extreme vertex.
struct Fit {
    double right, up;         ///< slopes of the frustum's sides
    double most[2][2];        ///< maxima of +-x - right * depth and of +-y - up * depth
    double nearest, farthest; ///< depths

    Fit(double rightSlope, double upSlope) : right(rightSlope), up(upSlope) {
        constexpr double kNothing = -std::numeric_limits<double>::infinity();
        for (auto& side : most) side[0] = side[1] = kNothing;
        nearest = -kNothing;
        farthest = kNothing;
    }

    /// Adds a point in camera axes: right, up, ahead.
    void add(const glm::dvec3& point) {
        for (int sign = 0; sign < 2; ++sign) {
            most[0][sign] = std::max(most[0][sign], (sign == 0 ? point.x : -point.x) - right * point.z);
            most[1][sign] = std::max(most[1][sign], (sign == 0 ? point.y : -point.y) - up * point.z);
        }
        nearest = std::min(nearest, point.z);
        farthest = std::max(farthest, point.z);
    }

    /// An eye e sees a point p if |p.x - e.x| <= right (p.z - e.z), and likewise for y: each side of the frustum is a
    /// plane that must not clip points. The image is centred between the most extreme ones.
    glm::dvec3 eye(double leastDepth) const {
        const double depth = std::min({-(most[0][0] + most[0][1]) / (2.0 * right),
                                       -(most[1][0] + most[1][1]) / (2.0 * up), nearest - leastDepth});
        return {0.5 * (most[0][0] - most[0][1]), 0.5 * (most[1][0] - most[1][1]), depth};
    }
};

} // namespace

Box3 boundsOverClips(Scene& scene) {
    Box3 boundsWS;
    overClips(scene, [&](const Scene& posed) {
        const Box3 nowWS = worldBounds(posed);
        if (nowWS.empty()) return;
        boundsWS.extend(nowWS.min);
        boundsWS.extend(nowWS.max);
    });
    return boundsWS;
}

Framing framingOf(Scene& scene, double fovYRadians, double aspect) {
    assert(aspect > 0.0 && fovYRadians > 0.0);
    const Box3 boundsWS = boundsOverClips(scene);
    const glm::dvec3 centerWS = boundsWS.empty() ? glm::dvec3(0.0) : 0.5 * (boundsWS.min + boundsWS.max);
    const glm::dvec3 sides = boundsWS.empty() ? glm::dvec3(0.0) : boundsWS.max - boundsWS.min;
    Framing framing;
    framing.radiusMetres = 0.5 * glm::length(sides);
    if (!std::isfinite(framing.radiusMetres) || !std::isfinite(glm::length(centerWS)))
        throw InputError("scene '" + scene.name + "': its bounds are too large for a camera; check the nodes' scales");

    const bool hasSize = framing.radiusMetres > 0.0;
    if (!hasSize) framing.radiusMetres = 1.0;
    const glm::dvec3 back = towardsEyeWS(scene, sides);
    const glm::dmat3 axes(worldFromLookAt(centerWS + back, centerWS));
    const double up = std::tan(0.5 * fovYRadians) / kMargin;
    Fit fit(up * aspect, up);
    const auto add = [&](const glm::dvec3& fromCenterWS) {
        fit.add({glm::dot(fromCenterWS, axes[0]), glm::dot(fromCenterWS, axes[1]), -glm::dot(fromCenterWS, axes[2])});
    };
    if (hasSize) {
        overClips(scene, [&](const Scene& posed) {
            forEachCornerWS(posed, [&](const glm::dvec3& positionWS) { add(positionWS - centerWS); });
        });
    } else {
        for (int i = 0; i < 8; ++i)
            add(glm::dvec3(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0) / std::sqrt(3.0));
    }
    const glm::dvec3 eye = fit.eye(2.0 * kLeastShare * framing.radiusMetres);
    const double middleDepth = 0.5 * (fit.nearest + fit.farthest);
    const glm::dvec3 onAxisWS = centerWS + axes[0] * eye.x + axes[1] * eye.y;
    framing.eyeWS = onAxisWS - axes[2] * eye.z;
    framing.targetWS = onAxisWS - axes[2] * middleDepth;
    return framing;
}

} // namespace tessera::scenes
