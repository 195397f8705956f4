#include "validation/reference/SeenLights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scenes/AreaLight.h"
#include "validation/reference/LightSurface.h"

namespace tessera::reference {

namespace {

using scenes::LightType;

/// An interval of depths along a ray.
struct DepthSpan {
    double entry = -std::numeric_limits<double>::infinity();
    double exit = std::numeric_limits<double>::infinity();
};

/// Depths at which |start + t direction| is at most the radius: between the roots of a t^2 + 2 b t + c. The root
/// without cancellation is q / a with q = -b - sign(b) sqrt(b^2 - a c), the other c / q.
std::optional<DepthSpan> withinRound(const glm::dvec3& start, const glm::dvec3& direction, double radius) {
    const double a = glm::dot(direction, direction), b = glm::dot(start, direction),
                 c = glm::dot(start, start) - radius * radius;
    if (a == 0.0) return c <= 0.0 ? std::optional(DepthSpan()) : std::nullopt;
    const double inRoot = b * b - a * c;
    if (inRoot < 0.0) return {};
    const double q = -b - std::copysign(std::sqrt(inRoot), b);
    if (q == 0.0) return DepthSpan{0.0, 0.0};
    return DepthSpan{std::min(q / a, c / q), std::max(q / a, c / q)};
}

/// Depths at which a coordinate that begins at `start` and grows by `step` is within -most .. most.
std::optional<DepthSpan> withinSlab(double start, double step, double most) {
    if (step == 0.0) return std::abs(start) <= most ? std::optional(DepthSpan()) : std::nullopt;
    const double one = (-most - start) / step, other = (most - start) / step;
    return DepthSpan{std::min(one, other), std::max(one, other)};
}

/// Whether a point is inside an outline, by the sum of the angles that the edges subtend there.
bool isWithin(const scenes::LightCorners& corners, const glm::dvec2& place) {
    const std::span<const glm::vec2> all = corners.all();
    double turned = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const glm::dvec2 a = glm::dvec2(all[i]) - place, b = glm::dvec2(all[(i + 1) % all.size()]) - place;
        turned += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
    }
    return std::abs(turned) > std::numbers::pi;
}

static_assert(scenes::kAreaTypeCount == 5 && scenes::kFlatTypeCount == 3,
              "a new shape needs a case in entryOf() or entryOfFlat(), which treat any other shape as a tube or a "
              "rectangle");

/// The depth at which a ray meets a flat light: solves middle + x along + y across = origin + t direction.
std::optional<double> entryOfFlat(const scenes::Light& light, const glm::dvec3& start, const glm::dvec3& direction) {
    glm::dvec3 along = light.alongWS;
    if (light.type == LightType::Disk) {
        // Any axes in its plane serve a disk.
        const glm::dvec3 axes[] = {{1, 0, 0}, {0, 1, 0}};
        along = glm::normalize(glm::cross(light.directionWS, axes[std::abs(light.directionWS.x) > 0.5 ? 1 : 0]));
    }
    const glm::dvec3 across = glm::cross(light.directionWS, along);
    const double determinant = glm::determinant(glm::dmat3(along, across, -direction));
    // The determinant is minus the direction's component along the light's: above 0 the ray comes from the front.
    if (determinant == 0.0 || (determinant < 0.0 && !light.isTwoSided)) return {};
    const double x = glm::determinant(glm::dmat3(start, across, -direction)) / determinant;
    const double y = glm::determinant(glm::dmat3(along, start, -direction)) / determinant;
    const double depth = glm::determinant(glm::dmat3(along, across, start)) / determinant;
    const double radius = double(light.radiusMetres);
    const bool isMet = light.type == LightType::Polygon ? isWithin(light.corners, {x, y})
                       : light.type == LightType::Disk  ? x * x + y * y <= radius * radius
                                                        : std::abs(x) <= 0.5 * double(light.widthMetres) &&
                                                             std::abs(y) <= 0.5 * double(light.heightMetres);
    return isMet ? std::optional(depth) : std::nullopt;
}

/// The depth at which a ray enters the surface; `start` is its origin from the light's middle.
std::optional<double> entryOf(const scenes::Light& light, const glm::dvec3& start, const glm::dvec3& direction) {
    if (scenes::infoOf(light.type).isFlat) return entryOfFlat(light, start, direction);
    const double radius = double(light.radiusMetres);
    if (light.type == LightType::Sphere) {
        const std::optional<DepthSpan> ball = withinRound(start, direction, radius);
        return ball ? std::optional(ball->entry) : std::nullopt;
    }
    const glm::dvec3& axis = light.directionWS;
    const double startAlong = glm::dot(start, axis), directionAlong = glm::dot(direction, axis);
    const std::optional<DepthSpan> mantle =
        withinRound(start - startAlong * axis, direction - directionAlong * axis, radius);
    const std::optional<DepthSpan> slab = withinSlab(startAlong, directionAlong, 0.5 * double(light.lengthMetres));
    if (!mantle || !slab) return {};
    const double entry = std::max(mantle->entry, slab->entry), exit = std::min(mantle->exit, slab->exit);
    return entry <= exit ? std::optional(entry) : std::nullopt;
}

bool isShown(const scenes::Light& light) {
    return scenes::infoOf(light.type).isArea && light.isSeen && scenes::hasSurface(light);
}

} // namespace

SeenLights::SeenLights(std::span<const ShiningLight> lights, const CameraRays& rays)
    : lights_(lights), nearMetres_(rays.nearMetres()), farMetres_(rays.farMetres()) {
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (isShown(lights[i].light)) shown_.push_back(i);
}

std::optional<SeenLights::Met> SeenLights::before(const Ray& ray, double depthMetres) const {
    return between(ray, nearMetres_, std::min(farMetres_, depthMetres));
}

std::optional<SeenLights::Met> SeenLights::ahead(const Ray& ray, double depthMetres) const {
    return between(ray, 0.0, depthMetres);
}

std::optional<SeenLights::Met> SeenLights::between(const Ray& ray, double nearMetres, double farMetres) const {
    std::optional<Met> nearest;
    for (const std::size_t i : shown_) {
        const std::optional<double> entry =
            entryOf(lights_[i].light, ray.originRWS - lights_[i].positionRWS, ray.direction);
        if (!entry || *entry < nearMetres || *entry > farMetres) continue;
        if (!nearest || *entry <= nearest->depthMetres) nearest = {i, *entry};
    }
    if (nearest)
        nearest->factor = LightSurface(lights_[nearest->light], lights_[nearest->light].positionRWS - ray.originRWS)
                              .factorAt(ray.direction);
    return nearest;
}

std::vector<scenes::Box3> SeenLights::boxesRWS(std::span<const ShiningLight> lights) {
    std::vector<scenes::Box3> boxes;
    for (const ShiningLight& shining : lights) {
        if (!isShown(shining.light)) continue;
        // The product's boxes are rotated with their lights: their corners lie up to sqrt(2) times as far out.
        const glm::dvec3 half(std::numbers::sqrt2 * scenes::surfaceReachMetres(shining.light));
        boxes.push_back({shining.positionRWS - half, shining.positionRWS + half});
    }
    return boxes;
}

} // namespace tessera::reference
