// Means of an environment around a direction, as visible through bodies of glass.
#include "validation/reference/Surroundings.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "scenes/builtin/Pictures.h"
#include "tests/support/Random.h"

namespace tessera::reference {
namespace {

/// 1 + slope x height, which is smooth in all directions.
scenes::Scene underASlope(double slope) {
    constexpr int kWidth = 256, kHeight = 128;
    scenes::Scene scene;
    scene.environment = {"slope", scenes::builtin::drawRadiance("slope", kWidth, kHeight, [&](int, int y) {
                             return glm::dvec3(1.0 + slope * std::cos(std::numbers::pi * (y + 0.5) / kHeight));
                         })};
    return scene;
}

/// Mean cosine to the axis of light refracted by GGX microfacets for a viewer along the axis, integrated over their
/// tilt by the midpoint rule. Source: Walter et al. 2007, equation 41 by half vectors, without masking of the viewer's
/// ray.
double meanCosine(double alpha, double ior) {
    constexpr int kSteps = 20000;
    double weights = 0.0, sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double lean = (i + 0.5) * 0.5 * std::numbers::pi / kSteps, cosine = std::cos(lean);
        const double sine = ior > 0.0 ? std::sin(lean) / ior : 0.0;
        if (sine >= 1.0) break;
        const double turned = lean - std::asin(sine), spread = cosine * cosine * (alpha * alpha - 1.0) + 1.0;
        if (turned >= 0.5 * std::numbers::pi) break;
        // Fresnel amplitudes of the angles to the microfacet: sin(a - b) / sin(a + b) and tan(a - b) / tan(a + b).
        const double crossed = std::sin(turned) / std::sin(lean + std::asin(sine));
        const double along = std::tan(turned) / std::tan(lean + std::asin(sine));
        const double passed = ior > 0.0 ? 1.0 - 0.5 * (crossed * crossed + along * along) : 1.0;
        const double masked = 2.0 / (1.0 + std::hypot(1.0, alpha * std::tan(turned)));
        // D (h.n) over the viewer's cosine to the microfacet.
        const double weight = cosine * std::sin(lean) / (spread * spread) * masked * passed;
        weights += weight;
        sum += weight * std::cos(turned);
    }
    return sum / weights;
}

TEST(ReferenceSurroundings, throughFacetsShowsTheMeanOfTheirLobe) {
    constexpr double kSlope = 0.8;
    const scenes::Scene scene = underASlope(kSlope);
    Settings settings;
    settings.environmentPaths = 8192;
    const Surroundings surroundings(scene, settings);
    const auto isHidden = [](const glm::dvec3&, const glm::dvec3&) { return false; };
    test::Random random(26);
    for (const double ior : {0.0, 0.8, 1.3, 1.5, 2.4})
        for (const double alpha : {0.02, 0.1, 0.4, 1.0}) {
            const glm::dvec3 direction = random.direction();
            const Scatter way{{}, direction, Facets(-direction, alpha, -direction, ior, Facets::Send::Through), 0.5};
            // Noise of the samples.
            EXPECT_NEAR(surroundings.through({&way, 1}, 7, isHidden).g,
                        1.0 + kSlope * direction.y * meanCosine(alpha, ior), 7e-3)
                << alpha << ", " << ior << ", height " << direction.y;
        }
    const Scatter clear{{}, {0.6, 0.8, 0.0}, {}, 0.5};
    EXPECT_EQ(surroundings.through({&clear, 1}, 0, isHidden), surroundings.radianceOf(clear.direction));
}

/// Almost smooth facets pass and reflect what a smooth interface does: by Fresnel's amplitudes, sin(a - b) / sin(a + b)
/// and tan(a - b) / tan(a + b).
TEST(ReferenceFacets, thatAreFinePassAndReflectWhatFresnelSays) {
    for (const double ior : {0.7, 1.5, 2.4})
        for (const double in : {0.3, 0.7, 1.2, 1.45}) {
            const glm::dvec3 toViewer(std::sin(in), 0.0, std::cos(in));
            double reflected = 1.0;
            if (const double sine = std::sin(in) / ior; sine < 1.0) {
                const double out = std::asin(sine);
                reflected = 0.5 * (std::pow(std::sin(in - out) / std::sin(in + out), 2.0) +
                                   std::pow(std::tan(in - out) / std::tan(in + out), 2.0));
            }
            const auto whole = [&](Facets::Send send) {
                return Facets({0.0, 0.0, 1.0}, 1e-4, toViewer, ior, send).whole();
            };
            EXPECT_NEAR(whole(Facets::Send::Back), reflected, 1e-4) << ior << ", " << in;
            EXPECT_NEAR(whole(Facets::Send::Through), 1.0 - reflected, 1e-4) << ior << ", " << in;
        }
}

/// Under uniform illumination a white matte surface reflects pi times its radiance (its model has no 1/pi), scaled by
/// the occlusion texture.
TEST(ReferenceSurroundings, occlusionLeavesItsShareOfTheirLight) {
    const scenes::Scene scene = underASlope(0.0);
    Settings settings;
    settings.environmentPaths = 1024;
    const Surroundings surroundings(scene, settings);
    SurfacePoint point;
    point.color = glm::dvec3(1.0);
    point.normal = {0.0, 1.0, 0.0};
    for (const double share : {1.0, 0.25, 0.0}) {
        point.openness = share;
        const Estimate found = surroundings.on(point, {0.0, 1.0, 0.0}, true, false, 0, settings.environmentPaths);
        EXPECT_NEAR(found.light.g, share * std::numbers::pi, 0.02);
    }
}

TEST(ReferenceSurroundings, bodiesShowThemWhereTheyLightSurfaces) {
    const scenes::Scene scene = underASlope(0.0);
    Settings settings;
    EXPECT_TRUE(Surroundings(scene, settings).showsThroughBodies());
    settings.environmentLights = false;
    EXPECT_FALSE(Surroundings(scene, settings).showsThroughBodies());
    EXPECT_FALSE(Surroundings(scenes::Scene(), Settings()).showsThroughBodies());
    settings.environmentLights = true;
    settings.soloLight = 0;
    EXPECT_FALSE(Surroundings(scene, settings).showsThroughBodies());
}

} // namespace
} // namespace tessera::reference
