// How wide the lobes are that levels of an environment were filtered by.
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

/// Of light that a GGX lobe reflects straight back, about the normal, weighted by the cosine of the light. Facets lean
/// by angles whose tangent is alpha sqrt(q / (1 - q)) where q is the share of them that leans less, by their area along
/// the normal (Walter 2007); light leaves at twice their angle.
double meanCosineOfLevel(double alpha) {
    constexpr int kFacets = 100000; // errs by less than 1e-6
    double cosines = 0.0, squares = 0.0;
    for (int i = 0; i < kFacets; ++i) {
        const double share = (i + 0.5) / kFacets, tangent2 = alpha * alpha * share / (1.0 - share);
        const double cosine = std::max((1.0 - tangent2) / (1.0 + tangent2), 0.0); // of the double angle
        cosines += cosine;
        squares += cosine * cosine;
    }
    return squares / cosines;
}

/// A map of such light: an axis a channel.
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

/// Levels are by the same factor wider than the one before, from the least to 1.
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

/// Light that rises in proportion to an axis stays so under any lobe that is round, and rises by the mean cosine of the
/// lobe as much: the width of each level is in one number.
TEST(EnvironmentLevels, flattenALinearSlopeOfLightByTheMeanCosineOfTheirLobe) {
    EXPECT_NEAR(meanCosineOfLevel(1.0), 2.0 / 3.0, 1e-6); // all facets alike: of u from 0 to 1 the mean by weight u
    EXPECT_NEAR(meanCosineOfLevel(0.13895), 0.93080, 1e-5);
    const FilteredEnvironment filtered = filteredSlopes(512, 256);
    ASSERT_GE(filtered.levels.size(), 5u);
    // Each level is averaged from pictures as coarse as its samples lie apart, whose texels widen the lobe: by 1.4 % of
    // the slope at alpha 1, where they are a tenth of a radian wide, by 0.5 % and less before. That is 1.8e-3 of the
    // light at most. A lobe without the weight of the cosine is off by 0.03 at alpha 1, one of half the alpha by 3e-3
    // and more from alpha 0.06 on.
    expectSlopes(filtered, 2e-3);
    // The mean over a clamped cosine, which harmonics of the first order hold.
    SCOPED_TRACE("irradiance");
    expectSlope(filtered.irradiance, std::numbers::pi, 2.0 / 3.0, 1e-3);
}

/// Maps of few texels are filtered to smaller pictures, by as many samples as the places of those need.
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

/// A round lobe keeps a share of a harmonic of light, its own mean of it: of order 8 it tells narrow lobes apart, which
/// a slope of light does not.
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
        // What is kept, by the level's own part of the harmonic: the mean of both over the sphere.
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
        // An alpha of a half or 1.5 times as much keeps 0.03 more or less of the first level and 0.06 to 0.2 of others.
        EXPECT_NEAR(shares.back(), sum / weights, 0.015) << "alpha " << alpha;
    }
    EXPECT_TRUE(std::ranges::is_sorted(shares, std::greater<>()));
}

} // namespace
} // namespace tessera::frame
