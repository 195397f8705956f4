#include "validation/stress/StressDirections.h"

#include <cmath>
#include <numbers>

namespace tessera::validation {

namespace {

/// A cosine near the horizon: of any order of magnitude from 1e-8 to 0.01, on either side of it, or 0.
double grazing(StressRandom& random) {
    return random.index(8) == 0 ? 0.0 : random.sign() * random.logarithmic(1e-8, 1e-2);
}

void placeRandom(StressView& view, double, StressRandom& random) {
    view.toLight = glm::vec3(random.direction());
    view.toViewer = glm::vec3(random.direction());
}

void placeAtPeak(StressView& view, double alpha, StressRandom& random) {
    // The light mirrored at a half vector within the lobe about the normal: n.h -> 1.
    const glm::dvec3 normal(view.normal);
    const double angle = std::atan(alpha * std::tan(0.49 * std::numbers::pi * random.unit()));
    const glm::dvec3 half = random.around(normal, std::cos(angle));
    const glm::dvec3 light = random.around(normal, random.between(0.0, 1.0));
    view.toLight = glm::vec3(light);
    view.toViewer = glm::vec3(glm::normalize(2.0 * glm::dot(light, half) * half - light));
}

void placeGrazingLight(StressView& view, double, StressRandom& random) {
    view.toLight = glm::vec3(random.around(glm::dvec3(view.normal), grazing(random)));
    view.toViewer = glm::vec3(random.around(glm::dvec3(view.normal), random.unit()));
}

void placeGrazingView(StressView& view, double, StressRandom& random) {
    view.toLight = glm::vec3(random.around(glm::dvec3(view.normal), random.unit()));
    view.toViewer = glm::vec3(random.around(glm::dvec3(view.normal), grazing(random)));
}

void placeGrazingBoth(StressView& view, double, StressRandom& random) {
    view.toLight = glm::vec3(random.around(glm::dvec3(view.normal), grazing(random)));
    view.toViewer = random.index(2) == 0 ? glm::vec3(random.around(glm::dvec3(view.normal), grazing(random)))
                                         : glm::vec3(glm::reflect(-glm::dvec3(view.toLight), glm::dvec3(view.normal)));
}

void placeSame(StressView& view, double, StressRandom& random) {
    view.toLight = view.toViewer = glm::vec3(random.direction());
}

void placeOpposite(StressView& view, double, StressRandom& random) {
    view.toLight = glm::vec3(random.direction());
    view.toViewer = -view.toLight;
    // Sometimes a few roundings away from exactly opposite.
    if (random.index(2) == 0)
        view.toViewer = glm::vec3(random.around(glm::dvec3(view.toViewer), 1.0 - random.logarithmic(1e-14, 1e-6)));
}

void placeAlongNormal(StressView& view, double, StressRandom& random) {
    view.toLight = view.toViewer = view.normal;
    if (random.index(2) == 0) view.toViewer = -view.normal;
}

constexpr StressDirection kDirections[] = {
    {"random", "any light and any viewer, below the horizon too", placeRandom},
    {"peak", "half vectors within the lobe, n.h -> 1", placeAtPeak},
    {"grazing_light", "n.l from -0.01 to 0.01, 0 too", placeGrazingLight},
    {"grazing_view", "n.v from -0.01 to 0.01, 0 too", placeGrazingView},
    {"grazing_both", "light and viewer near the horizon, mirrored too", placeGrazingBoth},
    {"same", "l = v", placeSame},
    {"opposite", "l = -v, and a rounding beside it", placeOpposite},
    {"normal", "l = n, v = n and v = -n to the last bit", placeAlongNormal},
};

} // namespace

std::span<const StressDirection> stressDirections() {
    return kDirections;
}

StressView stressView(const StressDirection& direction, double alpha, StressRandom& random) {
    StressView view{};
    const glm::dvec3 normal = random.direction();
    view.normal = glm::vec3(normal);
    view.tangent = glm::vec3(random.around(normal, 0.0));
    direction.place(view, alpha, random);
    return view;
}

} // namespace tessera::validation
