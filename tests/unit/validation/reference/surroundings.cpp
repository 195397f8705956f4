// Means of an environment around a direction, as bodies of glass show them.
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

/// The mean cosine to the axis of light that mirrors send which lean by GGX, seen along the axis, weighted by that
/// cosine: over the angle by which they lean, to 45 degrees, by the midpoint rule.
double meanCosine(double alpha) {
    constexpr int kSteps = 20000;
    double weights = 0.0, sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double lean = (i + 0.5) * 0.25 * std::numbers::pi / kSteps, c2 = std::cos(lean) * std::cos(lean);
        const double spread = c2 * (alpha * alpha - 1.0) + 1.0;
        // D, times the cosine that a mirror's solid angle takes: dl = 4 cos dh, of density D / 4.
        const double weight =
            alpha * alpha / (spread * spread) * std::cos(lean) * std::sin(lean) * std::cos(2.0 * lean);
        weights += weight;
        sum += weight * std::cos(2.0 * lean);
    }
    return sum / weights;
}

TEST(ReferenceSurroundings, theMeanAroundADirectionIsThatOfItsLobe) {
    constexpr double kSlope = 0.8;
    const scenes::Scene scene = underASlope(kSlope);
    Settings settings;
    settings.environmentPaths = 8192;
    const Surroundings surroundings(scene, settings);
    test::Random random(26);
    for (const double alpha : {0.02, 0.1, 0.4, 1.0})
        for (std::uint32_t seed = 0; seed < 4; ++seed) {
            const glm::dvec3 direction = random.direction();
            // Noise of the samples.
            EXPECT_NEAR(surroundings.around(direction, alpha, seed).g, 1.0 + kSlope * direction.y * meanCosine(alpha),
                        1e-2)
                << alpha << ", height " << direction.y;
        }
    const glm::dvec3 direction(0.6, 0.8, 0.0);
    EXPECT_EQ(surroundings.around(direction, kSmallestAlpha, 0), surroundings.radianceOf(direction)) << "a clear body";
}

/// Of even light a white matte surface reflects pi times its radiance (its model has no 1/pi), of which occlusion
/// leaves the share that its texture says.
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
