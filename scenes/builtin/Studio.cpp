#include <algorithm>
#include <cmath>

#include "scenes/Environment.h"
#include "scenes/builtin/Environments.h"
#include "scenes/builtin/Pictures.h"

namespace tessera::scenes::builtin {
namespace {

/// A soft box: a rectangle in the plane 1 m ahead in its direction, brightest in the middle.
struct Box {
    glm::dvec3 direction;
    glm::dvec2 halfSizeMetres;
    double edgeMetres; ///< width of the fade at its edges
    glm::dvec3 radiance;
};

// Azimuths are for a camera that looks along -(1, 0.7, 1): its left is (-1, 0, 1). No box is in its view.
const Box kBoxes[] = {
    {{-0.10, 0.95, 1.25}, {0.56, 0.44}, 0.05, {5.6, 5.2, 4.7}},    // key, front left above
    {{1.35, 0.40, -0.10}, {0.75, 0.85}, 0.30, {0.85, 0.90, 0.98}}, // fill, right
    {{-1.28, 0.45, 0.12}, {0.13, 0.60}, 0.04, {4.6, 4.8, 5.2}},    // rim, left of the image
    {{0.45, 0.50, -1.25}, {0.11, 0.52}, 0.04, {3.4, 3.5, 3.7}},    // rim, right of the image
    {{0.0, 1.0, 0.0}, {0.42, 0.42}, 0.20, {1.1, 1.1, 1.15}},       // above
};

double smoothStep(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

glm::dvec3 boxRadiance(const Box& box, const glm::dvec3& direction) {
    const glm::dvec3 ahead = glm::normalize(box.direction);
    const double along = glm::dot(ahead, direction);
    if (along <= 0.0) return glm::dvec3(0.0);
    const glm::dvec3 aside = std::abs(ahead.y) > 0.999 ? glm::dvec3(0.0, 0.0, -1.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, aside)), up = glm::cross(right, ahead);
    const glm::dvec2 place = glm::dvec2(glm::dot(right, direction), glm::dot(up, direction)) / along;
    const glm::dvec2 inside = box.halfSizeMetres - glm::abs(place);
    const double share = smoothStep(0.0, box.edgeMetres, inside.x) * smoothStep(0.0, box.edgeMetres, inside.y);
    const glm::dvec2 fromMiddle = place / box.halfSizeMetres;
    return box.radiance * share * (1.0 - 0.35 * std::min(glm::dot(fromMiddle, fromMiddle), 2.0) / 2.0);
}

glm::dvec3 studioRadiance(const glm::dvec3& direction) {
    const double up = direction.y;
    // Walls and a floor with a smooth sweep between them, darker than what the boxes light, so that a model stands out.
    // Straight below, the floor is as bright as one of albedo 0.2 under the boxes, so that metal facing down is not
    // black.
    const glm::dvec3 wall =
        glm::mix(glm::dvec3(0.11, 0.11, 0.113), glm::dvec3(0.055, 0.055, 0.058), smoothStep(0.0, 1.0, up));
    const glm::dvec3 floor =
        glm::mix(glm::dvec3(0.105, 0.103, 0.101), glm::dvec3(0.219, 0.211, 0.204), smoothStep(0.0, 1.0, -up));
    glm::dvec3 radiance = glm::mix(floor, wall, smoothStep(-0.12, 0.12, up));
    for (const Box& box : kBoxes) radiance += boxRadiance(box, direction);
    return radiance;
}

} // namespace

Image makeStudio(const std::function<void(double)>& progress) {
    const auto radiance = [](int x, int y) {
        return studioRadiance(directionInMap({(x + 0.5) / kMapWidth, (y + 0.5) / kMapHeight}));
    };
    return drawRadiance("studio", kMapWidth, kMapHeight, radiance, progress);
}

} // namespace tessera::scenes::builtin
