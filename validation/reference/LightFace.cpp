#include "validation/reference/LightFace.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/AreaLight.h"
#include "validation/reference/SeenArea.h"

namespace tessera::reference {

glm::dvec3 besideOf(const glm::dvec3& direction) {
    return glm::normalize(
        glm::cross(direction, std::abs(direction.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0)));
}

static_assert(scenes::kAreaTypeCount == 5 && scenes::kFlatTypeCount == 3,
              "a new shape needs its places here, or it casts the shadows of a tube or a disk");

LightFace::LightFace(const scenes::Light& light, const glm::dvec3& ahead, double radius)
    : type_(light.type), radius_(radius), reach_(radius), area_(std::numbers::pi * radius * radius) {
    x_ = besideOf(ahead);
    y_ = glm::cross(x_, ahead);
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    if (!info.isArea || light.type == scenes::LightType::Sphere) return;
    reach_ = scenes::surfaceReachMetres(light);
    axis_ = light.directionWS;
    if (light.type == scenes::LightType::Tube) {
        radius_ = double(light.radiusMetres);
        halfLength_ = 0.5 * double(light.lengthMetres);
        return;
    }
    isFlat_ = true;
    x_ = info.isTurned() ? light.alongWS : besideOf(axis_);
    y_ = glm::cross(axis_, x_);
    sidesMetres_ = {light.widthMetres, light.heightMetres};
    if (!info.hasCorners()) return;
    triangles_ = trianglesWithin(light.corners);
    // The sum of the triangles, not scenes::signedArea(): the product, which is validated here, uses that one.
    area_ = 0.0;
    for (const Triangle& triangle : triangles_) {
        const double area = areaOf(triangle);
        area_ += area;
        middle_ += area / 3.0 * inPlane(triangle[0] + triangle[1] + triangle[2]);
    }
    middle_ /= area_;
}

glm::dvec3 LightFace::at(int ring, int rings, double turn, double third) const {
    const double column = (ring + third) / rings;
    if (!triangles_.empty()) return inPlane(inTriangles(column * area_, turn));
    if (type_ == scenes::LightType::Rectangle) return inPlane((glm::dvec2(column, turn) - 0.5) * sidesMetres_);
    const double angle = 2.0 * std::numbers::pi * turn, share = std::sqrt((ring + 0.5) / rings);
    return inPlane(radius_ * share * glm::dvec2(std::cos(angle), std::sin(angle))) +
           (2.0 * third - 1.0) * halfLength_ * axis_;
}

double LightFace::shareOfCut(double metres, const glm::dvec3& normal) const {
    if (halfLength_ > 0.0) return std::min(2.0 * metres / (std::numbers::pi * radius_), 1.0);
    const double sine = isFlat_ ? glm::length(glm::cross(axis_, normal)) : 1.0;
    return std::min(2.0 * reach_ * metres / (area_ * std::max(sine, 1e-12)), 1.0);
}

double LightFace::areaOf(const Triangle& triangle) {
    return 0.5 * std::abs(glm::determinant(glm::dmat2(triangle[1] - triangle[0], triangle[2] - triangle[0])));
}

glm::dvec2 LightFace::inTriangles(double squareMetres, double turn) const {
    for (const Triangle& triangle : triangles_) {
        const auto& [a, b, c] = triangle;
        const double area = areaOf(triangle);
        if (squareMetres < area) return a + std::sqrt(squareMetres / area) * (glm::mix(b, c, turn) - a);
        squareMetres -= area;
    }
    return triangles_.back()[1];
}

} // namespace tessera::reference
