#include "validation/reference/EvenLight.h"

#include <cmath>

#include "validation/reference/Reflectance.h"
#include "validation/reference/Sampling.h"

namespace tessera::reference {

namespace {

/// The point with its specular lobe alone: nothing is reflected below it, and no sheen or coat lies above.
SurfacePoint lobeAlone(const SurfacePoint& point) {
    SurfacePoint lobe = point;
    lobe.transmission = 1.0;
    lobe.sheenColor = glm::dvec3(0.0);
    lobe.coat = 0.0;
    return lobe;
}

/// Integrates over a grid of half vectors: circles around the normal, and azimuths along each.
glm::dvec3 integrated(const SurfacePoint& lobe, const glm::dvec3& toViewer) {
    constexpr int kCircles = 64, kTurns = 32;
    constexpr double kGolden = 0.618033988749895; // turns between the starts of neighbouring circles
    const Model& model = modelOf(lobe.model);
    const ByMicrofacets facets({lobe.alpha, lobe.alphaAcross}, lobe.normal, lobe.tangent, toViewer);
    glm::dvec3 sum(0.0);
    for (int circle = 0; circle < kCircles; ++circle)
        for (int turn = 0; turn < kTurns; ++turn) {
            // In place of a random number 1 - root^2 (derivative 2 root): circles are denser where microfacets lean
            // most, which reflect most at grazing angles.
            const double root = (circle + 0.5) / kCircles, weight = 2.0 * root;
            const double around = (turn + std::fmod(kGolden * circle, 1.0)) / kTurns;
            const glm::dvec3 toLight = facets.direction({1.0 - root * root, around});
            const Directions directions(lobe.normal, toLight, toViewer);
            const double density = facets.density(toLight);
            if (!directions.hasLobe() || !(density > 0.0)) continue;
            sum += weight / density * model.reflected(lobe, directions, true);
        }
    return sum / double(kCircles * kTurns);
}

} // namespace

glm::dvec3 reflectedOfEvenLight(const SurfacePoint& point, const glm::dvec3& toViewer) {
    const double cosView = glm::dot(point.normal, toViewer);
    if (!(cosView > 0.0)) return glm::dvec3(0.0);
    const SurfacePoint lobe = lobeAlone(point);
    const bool isRough = point.alpha > kSmallestAlpha || point.alphaAcross > kSmallestAlpha;
    return isRough ? integrated(lobe, toViewer) : modelOf(point.model).mirrored(lobe, cosView);
}

} // namespace tessera::reference
