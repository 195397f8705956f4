// Lobe widths of the levels of a filtered environment.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <gtest/gtest.h>

#include "renderer/frame/EnvironmentFilter.h"
#include "scenes/builtin/Pictures.h"
#include "shaders/shared/environment.h"

namespace tessera::frame {
namespace {

/// Mean cosine of light that a GGX lobe reflects along the normal, weighted by the cosine of the light. The
/// microfacets' quantile q, by area projected along the normal, tilts by an angle of tangent alpha sqrt(q / (1 - q))
/// (Walter 2007); light is reflected at twice that angle.
double meanCosineOfLevel(double alpha) {
    constexpr int kFacets = 100000; // error below 1e-6
    double cosines = 0.0, squares = 0.0;
    for (int i = 0; i < kFacets; ++i) {
        const double share = (i + 0.5) / kFacets, tangent2 = alpha * alpha * share / (1.0 - share);
        const double cosine = std::max((1.0 - tangent2) / (1.0 + tangent2), 0.0); // of the double angle
        cosines += cosine;
        squares += cosine * cosine;
    }
    return squares / cosines;
}

/// A map whose radiance is linear along an axis, another axis per channel.
constexpr double kSlope = 0.2;
FilteredEnvironment filteredSlopes(int width, int height) {
    return filterEnvironment(scenes::builtin::drawRadiance("slopes", width, height, [&](int x, int y) {
        return 1.0 + kSlope * scenes::directionInMap({(x + 0.5) / width, (y + 0.5) / height});
    }));
}

void expectSlope(const DividedOctahedron& level, double mean, double steepness, double error) {
    for (int y = 0; y <= level.side; ++y)
        for (int x = 0; x <= level.side; ++x) {
            const glm::dvec3 n = directionOf(DividedOctahedron::codeOfCorner(x, y, level.side));
            for (int axis = 0; axis < 3; ++axis)
                ASSERT_NEAR(double(level.at(x, y)[axis]), mean * (1.0 + kSlope * steepness * n[axis]), error)
                    << "axis " << axis << ", cosine to it " << n[axis];
        }
}

/// Alpha of a level: each level is wider than the previous one by a constant factor, from the least alpha to 1.
double alphaOf(std::size_t level, std::size_t levels) {
    return std::pow(ENVIRONMENT_LEAST_ALPHA, 1.0 - double(level) / double(levels - 1));
}

void expectSlopes(const FilteredEnvironment& filtered, double error) {
    const std::size_t levels = filtered.levels.size();
    for (std::size_t i = 0; i < levels; ++i) {
        SCOPED_TRACE(testing::Message() << "level " << i << ", alpha " << alphaOf(i, levels));
        expectSlope(filtered.levels[i], 1.0, meanCosineOfLevel(alphaOf(i, levels)), error);
    }
}

/// Radiance that is linear along an axis stays linear under any rotationally symmetric lobe; its slope is scaled by the
/// lobe's mean cosine. One number therefore measures the width of a level.
TEST(EnvironmentLevels, flattenALinearSlopeOfLightByTheMeanCosineOfTheirLobe) {
    EXPECT_NEAR(meanCosineOfLevel(1.0), 2.0 / 3.0, 1e-6); // u = 0 to 1 is uniform: its mean by weight u
    EXPECT_NEAR(meanCosineOfLevel(0.13895), 0.93080, 1e-5);
    const FilteredEnvironment filtered = filteredSlopes(512, 256);
    ASSERT_GE(filtered.levels.size(), 5u);
    // Each level averages images as coarse as its sample spacing, whose texels widen the lobe: by 1.4 % of the slope at
    // alpha 1, where they are a tenth of a radian wide, by 0.5 % and less before. That is at most 1.8e-3 of the light.
    // A lobe without the cosine weight is off by 0.03 at alpha 1, a lobe of half the alpha by 3e-3 and more from alpha
    // 0.06 on.
    expectSlopes(filtered, 2e-3);
    // The mean cosine of a clamped cosine lobe; harmonics of the first order represent it.
    SCOPED_TRACE("irradiance");
    expectSlope(filtered.irradiance, std::numbers::pi, 2.0 / 3.0, 1e-3);
}

/// At alpha 1 the light that a lobe reflects along the normal comes evenly from all directions, half of them below the
/// surface. So each of n samples covers side^2 / n texels, and each level halves a side; half a level is added.
TEST(EnvironmentLevels, sampleALobeOfAlpha1AtTheLevelOfItsDensity) {
    struct Case {
        int count, side, levels;
        double level;
    };
    for (const Case& one : {Case{256, 32, 5, 1.5},
                            {1024, 256, 8, 3.5},
                            {32, 128, 7, 5.0},
                            {1024, 16, 4, 0.0},
                            {16, 64, 3, 2.0},
                            {128, 64, 6, 3.0}}) {
        const std::vector<LobeSample> samples = lobeSamples(1.0, one.count, one.side, one.levels);
        ASSERT_EQ(samples.size(), std::size_t(one.count) / 2);
        double weights = 0.0;
        for (const LobeSample& sample : samples) {
            EXPECT_NEAR(sample.level + double(sample.share), one.level, 1e-6) << one.count << " of " << one.side;
            EXPECT_LE(sample.level, one.levels - 2); // the next level exists
            EXPECT_NEAR(double(sample.weight), double(sample.direction.z) * 4.0 / one.count, 1e-6);
            weights += double(sample.weight);
        }
        EXPECT_NEAR(weights, 1.0, 1e-6);
    }
}

/// Small maps are filtered to smaller levels, with as many samples as those need.
TEST(EnvironmentLevels, ofSmallMapsFlattenASlopeAsWell) {
    const FilteredEnvironment filtered = filteredSlopes(64, 32);
    ASSERT_EQ(filtered.levels.size(), std::size_t(ENVIRONMENT_LEVELS));
    expectSlopes(filtered, 2.5e-3); // as above, and 5e-4 of interpolation between the map's texels
}

/// Legendre's polynomial of order 8.
double eighthHarmonic(double c) {
    const double s = c * c;
    return ((((6435.0 * s - 12012.0) * s + 6930.0) * s - 1260.0) * s + 35.0) / 128.0;
}

/// A rotationally symmetric lobe scales a harmonic of light by its mean of the harmonic. Order 8 distinguishes narrow
/// lobes; a linear slope does not.
TEST(EnvironmentLevels, keepOfTheEighthHarmonicTheMeanOfTheirLobe) {
    constexpr double kPart = 0.5;
    constexpr int kMapWidth = 1024, kMapHeight = 512;
    const scenes::Image map = scenes::builtin::drawRadiance("eighth", kMapWidth, kMapHeight, [&](int x, int y) {
        const double up = scenes::directionInMap({(x + 0.5) / kMapWidth, (y + 0.5) / kMapHeight}).y;
        return glm::dvec3(1.0 + kPart * eighthHarmonic(up));
    });
    const FilteredEnvironment filtered = filterEnvironment(map);
    std::vector<double> shares;
    for (int i = 0; i < ENVIRONMENT_LEVELS; ++i) {
        const double alpha = alphaOf(std::size_t(i), ENVIRONMENT_LEVELS);
        constexpr int kFacets = 100000;
        double weights = 0.0, sum = 0.0;
        for (int k = 0; k < kFacets; ++k) {
            const double share = (k + 0.5) / kFacets, tangent2 = alpha * alpha * share / (1.0 - share);
            const double cosine = std::max((1.0 - tangent2) / (1.0 + tangent2), 0.0);
            weights += cosine;
            sum += cosine * eighthHarmonic(cosine);
        }
        // The scale: projection of the level onto the harmonic over the sphere.
        const DividedOctahedron& level = filtered.levels[std::size_t(i)];
        double own = 0.0, squares = 0.0;
        for (int y = 0; y <= level.side; ++y)
            for (int x = 0; x <= level.side; ++x) {
                const double harmonic =
                    eighthHarmonic(directionOf(DividedOctahedron::codeOfCorner(x, y, level.side)).y);
                own += harmonic * (double(level.at(x, y).x) - 1.0) / kPart;
                squares += harmonic * harmonic;
            }
        shares.push_back(own / squares);
        // Half or 1.5 times the alpha changes the scale by 0.03 at the first level and by 0.06 to 0.2 at others.
        EXPECT_NEAR(shares.back(), sum / weights, 0.015) << "alpha " << alpha;
    }
    EXPECT_TRUE(std::ranges::is_sorted(shares, std::greater<>()));
}

} // namespace
} // namespace tessera::frame
