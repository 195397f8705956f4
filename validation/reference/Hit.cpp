#include "validation/reference/Hit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tessera::reference {

namespace {

/// Ray differentials (Igehy 1999, "Tracing Ray Differentials"): where the rays of the next pixels meet the plane.
void setChanges(const Object& object, const Ray& ray, const glm::dvec3& edge1, const glm::dvec3& edge2, Hit& hit) {
    const glm::dvec3 area = glm::cross(edge1, edge2);
    const double slope = glm::dot(area, ray.direction), area2 = glm::dot(area, area);
    const auto changeOf = [&](const glm::dvec3& originStep, const glm::dvec3& directionStep) {
        const glm::dvec3 aside = originStep + hit.depthMetres * directionStep;
        const glm::dvec3 alongPlane = aside - glm::dot(area, aside) / slope * ray.direction;
        const double weight1 = glm::dot(glm::cross(alongPlane, edge2), area) / area2;
        const double weight2 = glm::dot(glm::cross(edge1, alongPlane), area) / area2;
        return glm::dvec3(-weight1 - weight2, weight1, weight2);
    };
    hit.weightsDx = changeOf(ray.originDx, ray.directionDx);
    hit.weightsDy = changeOf(ray.originDy, ray.directionDy);
    hit.perspective =
        (std::abs(glm::dot(area, ray.directionDx)) + std::abs(glm::dot(area, ray.directionDy))) / std::abs(slope);
    const double pixelMetres = glm::length(ray.originDx + hit.depthMetres * ray.directionDx);
    const Anchor& anchor = object.anchor;
    const double pointReach = glm::length(ray.at(hit.depthMetres) - anchor.centreRWS) + anchor.otherOriginMetres;
    double cornerReach = 0.0, largestReach = pointReach;
    for (int corner = 0; corner < 3; ++corner) {
        const double own = object.cornerReach(hit.triangle, corner);
        cornerReach += std::abs(hit.weights[corner]) * own;
        largestReach = std::max(largestReach, own);
    }
    const double longestEdge = std::max({glm::length(edge1), glm::length(edge2), glm::length(edge2 - edge1)});
    const double height = std::sqrt(area2) / longestEdge;
    hit.roundingMetres = kPositionRounding * cornerReach;
    hit.roundingPixels = kPositionRounding * (pointReach + cornerReach) / pixelMetres;
    hit.roundingLevels = kPositionRounding * largestReach / height * std::numbers::log2e;
}

} // namespace

std::optional<Hit> hitOf(const Object& object, std::uint32_t triangle, const Ray& ray) {
    const glm::dvec3 a = object.cornerRWS(triangle, 0);
    const glm::dvec3 edge1 = object.cornerRWS(triangle, 1) - a, edge2 = object.cornerRWS(triangle, 2) - a;
    const glm::dvec3 area = glm::cross(edge1, edge2);
    const double slope = glm::dot(area, ray.direction);
    if (slope == 0.0) return {};
    const glm::dvec3 toCorner = a - ray.originRWS;
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
    setChanges(object, ray, edge1, edge2, hit);
    return hit;
}

} // namespace tessera::reference
