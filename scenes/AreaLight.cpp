#include "scenes/AreaLight.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace tessera::scenes {

namespace {

double crossOf(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Orientation of the triangle a b c: 1 counterclockwise, -1 clockwise, 0 collinear.
int turnOf(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const double cross = crossOf(b - a, c - a);
    return int(cross > 0.0) - int(cross < 0.0);
}

/// Whether a point on the line through a and b lies between them.
bool isBetween(const glm::dvec2& place, const glm::dvec2& a, const glm::dvec2& b) {
    return glm::all(glm::lessThanEqual(glm::min(a, b), place)) && glm::all(glm::lessThanEqual(place, glm::max(a, b)));
}

/// Whether the edges a b and c d share a point.
bool doMeet(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
    const int ofC = turnOf(a, b, c), ofD = turnOf(a, b, d), ofA = turnOf(c, d, a), ofB = turnOf(c, d, b);
    if (ofC * ofD < 0 && ofA * ofB < 0) return true;
    return (ofC == 0 && isBetween(c, a, b)) || (ofD == 0 && isBetween(d, a, b)) || (ofA == 0 && isBetween(a, c, d)) ||
           (ofB == 0 && isBetween(b, c, d));
}

} // namespace

double signedArea(const LightCorners& corners) {
    const std::span<const glm::vec2> all = corners.all();
    double area = 0.0;
    // Relative to the first corner, which keeps the precision of outlines far from the light's position.
    for (std::size_t i = 2; i < all.size(); ++i)
        area += 0.5 * crossOf(glm::dvec2(all[i - 1]) - glm::dvec2(all[0]), glm::dvec2(all[i]) - glm::dvec2(all[0]));
    return area;
}

glm::dvec2 middleOf(const LightCorners& corners) {
    const std::span<const glm::vec2> all = corners.all();
    const glm::dvec2 first(all[0]);
    glm::dvec2 sum(0.0);
    double area = 0.0;
    for (std::size_t i = 2; i < all.size(); ++i) {
        const glm::dvec2 a = glm::dvec2(all[i - 1]) - first, b = glm::dvec2(all[i]) - first;
        sum += crossOf(a, b) * (a + b) / 3.0;
        area += crossOf(a, b);
    }
    return area == 0.0 ? first : first + sum / area;
}

std::vector<std::array<std::uint8_t, 3>> trianglesOf(const LightCorners& corners) {
    const std::span<const glm::vec2> all = corners.all();
    const int around = signedArea(corners) < 0.0 ? -1 : 1;
    const auto turn = [&](std::uint8_t a, std::uint8_t b, std::uint8_t c) {
        return around * turnOf(glm::dvec2(all[a]), glm::dvec2(all[b]), glm::dvec2(all[c]));
    };
    std::vector<std::uint8_t> left;
    for (std::size_t i = 0; i < all.size(); ++i) left.push_back(std::uint8_t(i));
    std::vector<std::array<std::uint8_t, 3>> triangles;
    // An ear is a corner that points outwards and whose triangle with its neighbours holds no other corner.
    while (left.size() > 3) {
        std::size_t ear = 0;
        for (std::size_t i = 0; i < left.size(); ++i) {
            const std::uint8_t a = left[(i + left.size() - 1) % left.size()], b = left[i],
                               c = left[(i + 1) % left.size()];
            const bool isFree = std::ranges::none_of(left, [&](std::uint8_t other) {
                return other != a && other != b && other != c && turn(a, b, other) >= 0 && turn(b, c, other) >= 0 &&
                       turn(c, a, other) >= 0;
            });
            // A corner on a straight edge can always be clipped.
            if (turn(a, b, c) == 0 || (turn(a, b, c) > 0 && isFree)) {
                ear = i;
                break;
            }
        }
        triangles.push_back({left[(ear + left.size() - 1) % left.size()], left[ear], left[(ear + 1) % left.size()]});
        left.erase(left.begin() + std::ptrdiff_t(ear));
    }
    if (left.size() == 3) triangles.push_back({left[0], left[1], left[2]});
    return triangles;
}

std::string cornersProblem(const LightCorners& corners) {
    const std::size_t count = corners.count;
    if (count < LightCorners::kLeast || count > LightCorners::kMost)
        return fmt::format("number {}; {} to {} are needed", count, LightCorners::kLeast, LightCorners::kMost);
    const std::span<const glm::vec2> all = corners.all();
    for (std::size_t i = 0; i < count; ++i)
        for (const float metres : {all[i].x, all[i].y})
            if (!(std::abs(double(metres)) <= kMostRadiusMetres))
                return fmt::format("have number {} at ({:g}, {:g}); both must lie between {:g} and {:g} m", i, all[i].x,
                                   all[i].y, -kMostRadiusMetres, kMostRadiusMetres);
    const auto at = [&](std::size_t i) { return glm::dvec2(all[i % count]); };
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count; ++j)
            if (at(i) == at(j)) return fmt::format("{} and {} lie in one place; keep one", i, j);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2 before = at(i + 1) - at(i), after = at(i + 2) - at(i + 1);
        if (turnOf(at(i), at(i + 1), at(i + 2)) == 0 && glm::dot(before, after) < 0.0)
            return fmt::format("fold back at number {}; no area lies between the two edges", (i + 1) % count);
        // Adjacent edges share a corner and are skipped.
        for (std::size_t j = i + 2; j < count; ++j)
            if ((j + 1) % count != i && doMeet(at(i), at(i + 1), at(j), at(j + 1)))
                return fmt::format("let the edge from number {} to {} meet that from number {} to {}; move one of them",
                                   i, i + 1, j, (j + 1) % count);
    }
    return {};
}

static_assert(kAreaTypeCount == 5,
              "a new shape needs a case in hasSurface(), largestSeenArea() and surfaceReachMetres(), which are 0 of "
              "types without an area");

bool hasSurface(const Light& light) {
    const auto isThere = [](float metres) { return metres >= kLeastAreaMetres; };
    switch (light.type) {
    case LightType::Rectangle:
        return isThere(light.widthMetres) && isThere(light.heightMetres);
    case LightType::Disk:
    case LightType::Sphere:
        return isThere(light.radiusMetres);
    case LightType::Tube:
        return isThere(light.radiusMetres) && isThere(light.lengthMetres);
    case LightType::Polygon:
        return std::abs(signedArea(light.corners)) >= double(kLeastAreaMetres) * double(kLeastAreaMetres);
    default:
        return false;
    }
}

double largestSeenArea(const Light& light) {
    const double radius = light.radiusMetres, disk = std::numbers::pi * radius * radius;
    switch (light.type) {
    case LightType::Rectangle:
        return double(light.widthMetres) * double(light.heightMetres);
    case LightType::Disk:
    case LightType::Sphere:
        return disk;
    case LightType::Tube:
        // Side view plus end view: an upper bound of all oblique views.
        return 2.0 * radius * double(light.lengthMetres) + disk;
    case LightType::Polygon:
        return std::abs(signedArea(light.corners));
    default:
        return 0.0;
    }
}

double surfaceReachMetres(const Light& light) {
    switch (light.type) {
    case LightType::Rectangle:
        return 0.5 * std::hypot(double(light.widthMetres), double(light.heightMetres));
    case LightType::Disk:
    case LightType::Sphere:
        return light.radiusMetres;
    case LightType::Tube:
        return std::hypot(double(light.radiusMetres), 0.5 * double(light.lengthMetres));
    case LightType::Polygon: {
        double reach = 0.0;
        for (const glm::vec2& corner : light.corners.all()) reach = std::max(reach, glm::length(glm::dvec2(corner)));
        return reach;
    }
    default:
        return 0.0;
    }
}

std::optional<glm::dvec3> acrossFrom(const glm::dvec3& direction, const glm::dvec3& preferred) {
    const double along = glm::dot(preferred, direction);
    // A vector that is perpendicular up to rounding is returned unchanged.
    if (std::abs(along) < 4e-16) return preferred;
    const glm::dvec3 across = preferred - along * direction;
    constexpr double kLeastAcross = 1e-6; // half of the digits are left
    const double length = glm::length(across);
    if (!(length > kLeastAcross)) return {};
    return across / length;
}

glm::dvec3 usualAlong(const glm::dvec3& directionWS) {
    const glm::dvec3 horizontal = glm::cross(glm::dvec3(0.0, 1.0, 0.0), directionWS);
    constexpr double kVertical = 1e-6; // sine of the angle from the vertical
    const double length = glm::length(horizontal);
    if (length > kVertical) return horizontal / length;
    return acrossFrom(directionWS, {1.0, 0.0, 0.0}).value_or(glm::dvec3(1.0, 0.0, 0.0));
}

glm::dvec3 alongOf(const Light& light) {
    return infoOf(light.type).isTurned() ? light.alongWS : usualAlong(light.directionWS);
}

} // namespace tessera::scenes
