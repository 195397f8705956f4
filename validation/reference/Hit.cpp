#include "validation/reference/Hit.h"

#include <cmath>

namespace tessera::reference {

std::optional<Hit> hitOf(const Object& object, std::uint32_t triangle, const Ray& ray) {
    const glm::dvec3 a = object.cornerRel(triangle, 0);
    const glm::dvec3 edge1 = object.cornerRel(triangle, 1) - a, edge2 = object.cornerRel(triangle, 2) - a;
    const glm::dvec3 area = glm::cross(edge1, edge2);
    const double slope = glm::dot(area, ray.direction);
    if (slope == 0.0) return {};
    const glm::dvec3 toCorner = a - ray.originRel;
    Hit hit;
    hit.object = &object;
    hit.triangle = triangle;
    hit.depthMetres = glm::dot(area, toCorner) / slope;
    // Cramer's rule on origin + t direction = a + w1 edge1 + w2 edge2.
    const glm::dvec3 across = glm::cross(ray.direction, toCorner);
    hit.weights.y = -glm::dot(edge2, across) / slope;
    hit.weights.z = glm::dot(edge1, across) / slope;
    hit.weights.x = 1.0 - hit.weights.y - hit.weights.z;
    hit.frontFacing = slope * object.handedness < 0.0;
    if (!std::isfinite(hit.depthMetres)) return {};
    return hit;
}

} // namespace tessera::reference
