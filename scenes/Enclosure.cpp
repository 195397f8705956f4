#include "scenes/Enclosure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "scenes/Corners.h"

namespace tessera::scenes {
namespace {

/// Minimum side of a room's bounds: smaller hollow things, such as helmets and bottles, are not entered.
constexpr double kLeastRoomMetres = 2.0;
constexpr double kEyeMetres = 1.7; ///< eye height above the floor; at most the middle of the bounds
/// Maximum fraction of rays that hit back faces. Upward rays may miss, since a courtyard is open to the sky.
constexpr double kMostBacks = 0.1;
/// Minimum fraction of front-face hits among rays whose elevation has at most this sine.
constexpr double kLeastFronts = 0.9, kLevel = 0.3;
constexpr double kTowardsWall = 0.8; ///< the eye, as a fraction of the way from the middle to the wall behind

constexpr int kRays = 64;      ///< in all directions
constexpr int kLevelRays = 32; ///< at the eye's height

struct Ray {
    glm::dvec3 directionWS{0.0};
    double metres = std::numeric_limits<double>::infinity(); ///< distance to the first hit
    bool meetsBack = false;
    bool meetsFront() const { return std::isfinite(metres) && !meetsBack; }
};

/// Evenly distributed over the sphere, along a spiral.
std::array<Ray, kRays> raysAround() {
    constexpr double kGoldenAngle = std::numbers::pi * (3.0 - 2.2360679774997896);
    std::array<Ray, kRays> rays;
    for (int i = 0; i < kRays; ++i) {
        const double y = 1.0 - (2.0 * i + 1.0) / kRays, radius = std::sqrt(1.0 - y * y), angle = kGoldenAngle * i;
        rays[std::size_t(i)].directionWS = {radius * std::cos(angle), y, radius * std::sin(angle)};
    }
    return rays;
}

std::array<Ray, kLevelRays> levelRays() {
    std::array<Ray, kLevelRays> rays;
    for (int i = 0; i < kLevelRays; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kLevelRays;
        rays[std::size_t(i)].directionWS = {std::cos(angle), 0.0, std::sin(angle)};
    }
    return rays;
}

/// Traces rays from one origin. A ray hits a triangle if it lies on the same side of the three planes through the
/// origin and an edge; the side distinguishes the front, counterclockwise, from the back.
template <std::size_t kCount>
void follow(const Scene& scene, const glm::dvec3& originWS, std::array<Ray, kCount>& rays) {
    std::array<glm::dvec3, 3> corners;
    std::size_t corner = 0;
    forEachCornerWS(scene, [&](const glm::dvec3& positionWS) {
        corners[corner] = positionWS - originWS;
        corner = (corner + 1) % 3;
        if (corner != 0) return;
        const auto& [a, b, c] = corners;
        const glm::dvec3 ab = glm::cross(a, b), bc = glm::cross(b, c), ca = glm::cross(c, a);
        const glm::dvec3 normal = ab + bc + ca;
        const double volume = glm::dot(a, bc); // its sign: the side that faces the origin
        if (volume == 0.0) return;
        for (Ray& ray : rays) {
            const auto isBeside = [&](const glm::dvec3& plane) {
                return glm::dot(ray.directionWS, plane) * volume < 0.0;
            };
            if (isBeside(ab) || isBeside(bc) || isBeside(ca)) continue;
            const double slope = glm::dot(ray.directionWS, normal);
            if (slope == 0.0) continue;
            const double metres = volume / slope;
            if (metres >= ray.metres) continue;
            ray.metres = metres;
            ray.meetsBack = slope > 0.0;
        }
    });
}

template <std::size_t kCount, typename Is, typename Holds>
double shareOf(const std::array<Ray, kCount>& rays, const Is& is, const Holds& holds) {
    const auto all = std::ranges::count_if(rays, is);
    const auto some = std::ranges::count_if(rays, [&](const Ray& ray) { return is(ray) && holds(ray); });
    return double(some) / double(all);
}

/// Whether a few rays down and to the sides suggest a room: for most objects they hit back faces or nothing, and the
/// full test is skipped.
bool mayBeEnclosed(const Scene& scene, const glm::dvec3& originWS) {
    constexpr std::size_t kProbes = 8, kLeastFrontProbes = 6;
    const std::array<Ray, kRays> around = raysAround();
    std::array<Ray, kProbes> probes;
    for (std::size_t i = 0; i < kProbes; ++i) probes[i] = around[kRays - 1 - 4 * i];
    follow(scene, originWS, probes);
    return std::ranges::count_if(probes, [](const Ray& ray) { return ray.meetsFront(); }) >= int(kLeastFrontProbes);
}

bool isEnclosed(const std::array<Ray, kRays>& rays) {
    const auto isAny = [](const Ray&) { return true; };
    const auto isLevelOrDown = [](const Ray& ray) { return ray.directionWS.y <= kLevel; };
    const auto meetsFront = [](const Ray& ray) { return ray.meetsFront(); };
    return shareOf(rays, isAny, [](const Ray& ray) { return ray.meetsBack; }) <= kMostBacks &&
           shareOf(rays, isLevelOrDown, meetsFront) >= kLeastFronts;
}

} // namespace

std::optional<Framing> framingInside(const Scene& scene) {
    const Box3 boundsWS = worldBounds(scene);
    if (boundsWS.empty()) return std::nullopt;
    const glm::dvec3 sides = boundsWS.max - boundsWS.min, middleWS = 0.5 * (boundsWS.min + boundsWS.max);
    if (!(std::min({sides.x, sides.y, sides.z}) >= kLeastRoomMetres)) return std::nullopt;
    if (!mayBeEnclosed(scene, middleWS)) return std::nullopt;
    std::array<Ray, kRays> around = raysAround();
    follow(scene, middleWS, around);
    if (!isEnclosed(around)) return std::nullopt;
    // The steepest ray, the last one, finds the floor.
    const Ray& down = around.back();
    if (!std::isfinite(down.metres)) return std::nullopt;
    const double heightMetres = -down.directionWS.y * down.metres;
    const glm::dvec3 standsWS = middleWS - glm::dvec3(0.0, std::max(heightMetres - kEyeMetres, 0.0), 0.0);
    std::array<Ray, kLevelRays> level = levelRays();
    follow(scene, standsWS, level);
    const auto behind = [&](std::size_t i) -> const Ray& { return level[(i + kLevelRays / 2) % kLevelRays]; };
    std::optional<std::size_t> longest;
    const auto lengthOf = [&](std::size_t i) { return level[i].metres + behind(i).metres; };
    for (std::size_t i = 0; i < kLevelRays; ++i) {
        if (!std::isfinite(lengthOf(i))) continue;
        // A line's two directions are ranked by the space behind the middle.
        const auto rank = [&](std::size_t ray) { return std::pair(lengthOf(ray), behind(ray).metres); };
        if (!longest || rank(i) > rank(*longest)) longest = i;
    }
    if (!longest || lengthOf(*longest) < kLeastRoomMetres) return std::nullopt;
    Framing framing;
    framing.radiusMetres = 0.5 * glm::length(sides);
    framing.eyeWS = standsWS + kTowardsWall * behind(*longest).metres * behind(*longest).directionWS;
    framing.targetWS = standsWS;
    return framing;
}

} // namespace tessera::scenes
