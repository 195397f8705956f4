#include "validation/reference/LightSurface.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "scenes/AreaLight.h"
#include "validation/reference/SeenArea.h"

namespace tessera::reference {

namespace {

using scenes::LightType;

glm::dvec3 storedTexel(const scenes::Image& map, int column, int row) {
    const auto x = std::size_t(std::clamp(column, 0, map.width - 1)),
               y = std::size_t(std::clamp(row, 0, map.height - 1));
    glm::vec4 texel;
    std::memcpy(&texel, map.texels.data() + (y * std::size_t(map.width) + x) * sizeof texel, sizeof texel);
    return glm::dvec3(texel);
}

/// Bilinear between the centres of four texels; texels count from the image's top left corner.
glm::dvec3 factorOf(const scenes::Image& map, const glm::dvec2& texels) {
    const glm::dvec2 fromCentre = glm::clamp(texels - 0.5, glm::dvec2(0.0), glm::dvec2(map.width - 1, map.height - 1));
    const int column = int(fromCentre.x), row = int(fromCentre.y);
    const double right = fromCentre.x - column, down = fromCentre.y - row;
    return (1.0 - right) * (1.0 - down) * storedTexel(map, column, row) +
           right * (1.0 - down) * storedTexel(map, column + 1, row) +
           (1.0 - right) * down * storedTexel(map, column, row + 1) +
           right * down * storedTexel(map, column + 1, row + 1);
}

static_assert(scenes::kFlatTypeCount == 3, "a new shape needs a case in halfSidesOf() and isOnSurface()");

/// Half the sides of the light's image, in metres.
glm::dvec2 halfSidesOf(const scenes::Light& light) {
    if (light.type == LightType::Rectangle) return {0.5 * double(light.widthMetres), 0.5 * double(light.heightMetres)};
    if (light.type == LightType::Disk) return glm::dvec2(double(light.radiusMetres));
    double farthest = 0.0;
    for (const glm::vec2& corner : light.corners.all())
        farthest = std::max(farthest, std::hypot(double(corner.x), double(corner.y)));
    return glm::dvec2(farthest);
}

/// Whether a point of the light's plane lies on its surface; `triangles` are those of a polygon.
bool isOnSurface(const scenes::Light& light, const std::vector<std::array<glm::dvec2, 3>>& triangles,
                 const glm::dvec2& metres) {
    if (light.type == LightType::Rectangle) return true;
    if (light.type == LightType::Disk) return glm::length(metres) <= double(light.radiusMetres);
    const auto crossOf = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
    return std::ranges::any_of(triangles, [&](const std::array<glm::dvec2, 3>& triangle) {
        return crossOf(triangle[1] - triangle[0], metres - triangle[0]) >= 0.0 &&
               crossOf(triangle[2] - triangle[1], metres - triangle[1]) >= 0.0 &&
               crossOf(triangle[0] - triangle[2], metres - triangle[2]) >= 0.0;
    });
}

} // namespace

LightSurface::LightSurface(const ShiningLight& shining, const glm::dvec3& toMiddle)
    : light_(shining.light), toMiddle_(toMiddle), along_(scenes::alongOf(light_)),
      across_(glm::cross(light_.directionWS, along_)), halfMetres_(halfSidesOf(light_)) {}

glm::dvec2 LightSurface::texelsAt(const glm::dvec3& direction) const {
    const scenes::Image& map = light_.texture->map;
    const double facing = glm::dot(direction, light_.directionWS);
    const glm::dvec3 metres =
        facing == 0.0 ? glm::dvec3(0.0) : direction * (glm::dot(toMiddle_, light_.directionWS) / facing) - toMiddle_;
    const glm::dvec2 share = 0.5 + 0.5 * glm::dvec2(glm::dot(metres, along_), -glm::dot(metres, across_)) / halfMetres_;
    return share * glm::dvec2(map.width, map.height);
}

glm::dvec3 LightSurface::factorAt(const glm::dvec3& direction) const {
    return isEven() ? glm::dvec3(1.0) : factorOf(light_.texture->map, texelsAt(direction));
}

glm::dvec3 meanFactor(const scenes::Light& light) {
    if (!light.texture || !scenes::infoOf(light.type).isFlat) return glm::dvec3(1.0);
    constexpr int kSteps = 512; // points across; the mean serves approximations only
    const scenes::Image& map = light.texture->map;
    std::vector<std::array<glm::dvec2, 3>> triangles;
    if (light.type == LightType::Polygon) triangles = trianglesWithin(light.corners);
    const glm::dvec2 half = halfSidesOf(light);
    glm::dvec3 sum(0.0);
    int places = 0;
    for (int y = 0; y < kSteps; ++y)
        for (int x = 0; x < kSteps; ++x) {
            const glm::dvec2 share = (glm::dvec2(x, y) + 0.5) / double(kSteps);
            const glm::dvec2 metres = half * glm::dvec2(2.0 * share.x - 1.0, 1.0 - 2.0 * share.y);
            if (!isOnSurface(light, triangles, metres)) continue;
            sum += factorOf(map, share * glm::dvec2(map.width, map.height));
            ++places;
        }
    return places > 0 ? sum / double(places) : glm::dvec3(1.0);
}

} // namespace tessera::reference
