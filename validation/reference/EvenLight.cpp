#include "validation/reference/EvenLight.h"

#include <cmath>

#include "validation/reference/Microfacet.h"
#include "validation/reference/Reflectance.h"
#include "validation/reference/Sampling.h"

namespace tessera::reference {

namespace {

glm::dvec3 integratedLobe(const SurfacePoint& point, const glm::dvec3& toViewer) {
    constexpr int kWays = 64, kTurns = 32; // from the normal, and around it
    constexpr double kGolden = 0.618033988749895;
    SurfacePoint lobe = point;
    lobe.transmission = 1.0; // nothing is reflected below the lobe
    lobe.sheenColor = glm::dvec3(0.0);
    lobe.coat = 0.0;
    const Model& model = modelOf(point.model);
    const ByMicrofacets facets({point.alpha, point.alphaAcross}, point.normal, point.tangent, toViewer);
    glm::dvec3 sum(0.0);
    for (int way = 0; way < kWays; ++way)
        for (int turn = 0; turn < kTurns; ++turn) {
            // By the root of the share of facets that lean more, since at grazing angles those reflect most. Each
            // circle is turned a golden angle on, so that the horizon averages out.
            const double root = (way + 0.5) / kWays, share = 2.0 * root;
            const double around = (turn + std::fmod(kGolden * way, 1.0)) / kTurns;
            const glm::dvec3 toLight = facets.direction({1.0 - root * root, around});
            const Directions directions(point.normal, toLight, toViewer);
            const double density = facets.density(toLight);
            if (!directions.hasLobe() || !(density > 0.0)) continue;
            sum += share / density * model.reflected(lobe, directions, true);
        }
    return sum / double(kWays * kTurns);
}

} // namespace

glm::dvec3 reflectedOfEvenLight(const SurfacePoint& point, const glm::dvec3& toViewer) {
    const double cosView = glm::dot(point.normal, toViewer);
    if (!(cosView > 0.0)) return glm::dvec3(0.0);
    if (point.alpha > kSmallestAlpha || point.alphaAcross > kSmallestAlpha) return integratedLobe(point, toViewer);
    const ReflectanceRange range = reflectanceRange(point, cosView);
    glm::dvec3 mirrored;
    for (int c = 0; c < 3; ++c) mirrored[c] = fresnelSchlick(range.straight[c], range.grazing, cosView);
    return mirrored;
}

} // namespace tessera::reference
