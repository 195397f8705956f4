#include "validation/figures/Flip.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "tests/support/Random.h"
#include "validation/figures/FlipColour.h"
#include "validation/figures/FlipFilters.h"

namespace tessera::validation {
namespace {

using Code = std::array<int, 3>;

DisplayImage uniform(const Code& code, int width = 24, int height = 17) {
    DisplayImage image{width, height, {}};
    for (std::size_t i = 0; i < image.pixelCount(); ++i)
        for (const int c : code) image.rgb.push_back(std::uint8_t(c));
    return image;
}

DisplayImage noise(std::uint64_t seed, int width = 40, int height = 30) {
    test::Random random(seed);
    DisplayImage image{width, height, {}};
    for (std::size_t i = 0; i < 3 * image.pixelCount(); ++i) image.rgb.push_back(std::uint8_t(random.index(256)));
    return image;
}

double mean(const std::vector<float>& errors) {
    double sum = 0.0;
    for (const float error : errors) sum += double(error);
    return sum / double(errors.size());
}

TEST(Flip, equalPicturesHaveExactlyNoError) {
    for (const float error : flipErrors(noise(1), noise(1))) EXPECT_EQ(error, 0.0f);
}

TEST(Flip, theOrderOfThePicturesNeverMatters) {
    EXPECT_EQ(flipErrors(noise(2), noise(3)), flipErrors(noise(3), noise(2)));
}

TEST(Flip, everyErrorIsBetweenZeroAndOne) {
    DisplayImage checks = uniform({0, 255, 0}), inverse = uniform({0, 0, 255});
    for (std::size_t i = 0; i < checks.rgb.size(); i += 6) std::swap(checks.rgb[i + 1], inverse.rgb[i + 1]);
    for (const auto& [a, b] : {std::pair(noise(4), noise(5)), std::pair(checks, inverse)}) {
        const std::vector<float> errors = flipErrors(a, b);
        EXPECT_GE(*std::min_element(errors.begin(), errors.end()), 0.0f);
        EXPECT_LE(*std::max_element(errors.begin(), errors.end()), 1.0f);
        EXPECT_GT(mean(errors), 0.1);
    }
}

/// Constant images pass every filter unchanged and have no features, so that the error is the colour error alone. The
/// values were calculated from the paper's formulas outside of this program, with the matrix of IEC 61966-2-1.
TEST(Flip, uniformPicturesHaveTheErrorWorkedOutByHand) {
    struct Known {
        Code a, b;
        double flip;
    };
    const Known known[] = {{{0, 0, 0}, {255, 255, 255}, 0.967379}, {{128, 128, 128}, {132, 132, 132}, 0.078672},
                           {{255, 0, 0}, {0, 255, 0}, 0.986661},   {{200, 100, 50}, {190, 110, 60}, 0.197796},
                           {{0, 255, 0}, {0, 0, 255}, 1.0},        {{12, 10, 8}, {20, 10, 8}, 0.046878}};
    for (const Known& pair : known) {
        for (const float error : flipErrors(uniform(pair.a), uniform(pair.b))) {
            // Filters run in fp32: 1e-6 of a colour, which the exponent 0.7 makes at most 1e-4 of its error.
            EXPECT_NEAR(error, pair.flip, 1e-4) << pair.a[0] << " " << pair.a[1] << " " << pair.a[2];
        }
    }
}

TEST(Flip, aLargerDifferenceOfOneColourNeverHasASmallerError) {
    double last = 0.0;
    for (int code = 101; code <= 255; code += 7) {
        const double error = mean(flipErrors(uniform({100, 100, 100}), uniform({code, code, code})));
        EXPECT_GT(error, last) << code;
        last = error;
    }
}

TEST(Flip, aThinLineIsSeenBetterFromNearby) {
    const DisplayImage plain = uniform({128, 128, 128}, 64, 33);
    DisplayImage lined = plain;
    for (std::size_t y = 0; y < 33; ++y) lined.rgb[3 * (64 * y + 32)] = 255;
    const double near = mean(flipErrors(lined, plain, 20.0)), far = mean(flipErrors(lined, plain, 140.0));
    EXPECT_GT(near, 0.0);
    EXPECT_NE(near, far);
    const auto peak = [&](double pixelsPerDegree) {
        const std::vector<float> errors = flipErrors(lined, plain, pixelsPerDegree);
        return *std::max_element(errors.begin(), errors.end());
    };
    EXPECT_GT(peak(20.0), peak(140.0));
}

/// A feature counts: the same sum of colour differences, once as a smooth ramp and once as an edge.
TEST(Flip, anEdgeThatIsMissingCountsMoreThanItsColourAlone) {
    const DisplayImage plain = uniform({120, 120, 120}, 64, 33), shifted = uniform({140, 140, 140}, 64, 33);
    DisplayImage edge = plain;
    for (std::size_t i = 0; i < edge.pixelCount(); ++i)
        if (i % 64 >= 32) std::fill_n(edge.rgb.begin() + std::ptrdiff_t(3 * i), 3, std::uint8_t(140));
    const std::vector<float> withEdge = flipErrors(edge, plain), withoutEdge = flipErrors(shifted, plain);
    EXPECT_GT(withEdge[16 * 64 + 33], withoutEdge[16 * 64 + 33]);
}

TEST(FlipFilters, aConstantPlaneIsSeenUnchangedAndWithoutFeatures) {
    Plane plane(31, 19);
    std::fill(plane.values.begin(), plane.values.end(), 37.5f);
    for (const ContrastSensitivity& eye : {kAchromatic, kRedGreen, kBlueYellow})
        for (const float value : seenBy(eye, plane, kFlipPixelsPerDegree).values) EXPECT_NEAR(value, 37.5f, 2e-4f);
    const Features features = featuresOf(plane, kFlipPixelsPerDegree);
    for (const float value : features.edges.values) EXPECT_NEAR(value, 0.0f, 2e-4f); // 40 products of fp32 cancel
    for (const float value : features.points.values) EXPECT_NEAR(value, 0.0f, 2e-4f);
}

TEST(FlipFilters, aStepOfHeightOneIsAnEdgeOfHeightOne) {
    Plane plane(41, 41);
    for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] = i % 41 > 20 ? 1.0f : 0.0f;
    const Features features = featuresOf(plane, kFlipPixelsPerDegree);
    // At the step, each half of the slope kernel lies on one side of it; the kernel's centre has weight 0.
    EXPECT_NEAR(*std::max_element(features.edges.values.begin(), features.edges.values.end()), 1.0f, 1e-5f);
}

TEST(FlipFilters, aSinglePixelIsSpreadEvenlyAndKeepsItsSum) {
    Plane plane(61, 61);
    plane.values[30 * 61 + 30] = 1.0f;
    for (const ContrastSensitivity& eye : {kAchromatic, kRedGreen, kBlueYellow}) {
        const Plane seen = seenBy(eye, plane, kFlipPixelsPerDegree);
        EXPECT_NEAR(mean(seen.values) * 61.0 * 61.0, 1.0, 1e-5);
        EXPECT_NEAR(seen.values[30 * 61 + 27], seen.values[27 * 61 + 30], 1e-9f);
        EXPECT_GT(seen.values[30 * 61 + 30], seen.values[30 * 61 + 29]);
    }
    // The eye resolves lightness best and blue against yellow least.
    const auto peak = [&](const ContrastSensitivity& eye) {
        return seenBy(eye, plane, kFlipPixelsPerDegree).values[30 * 61 + 30];
    };
    EXPECT_GT(peak(kAchromatic), peak(kRedGreen));
    EXPECT_GT(peak(kRedGreen), peak(kBlueYellow));
}

TEST(FlipColour, opponentColoursGoThereAndBack) {
    test::Random random(6);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 rgb(random.unit(), random.unit(), random.unit());
        EXPECT_LT(glm::length(linearFromOpponent(opponentFromLinear(rgb)) - rgb), 1e-12);
    }
    // White has no chroma.
    EXPECT_NEAR(opponentFromLinear(glm::dvec3(1.0)).x, 100.0, 1e-12);
    EXPECT_NEAR(glm::length(glm::dvec2(opponentFromLinear(glm::dvec3(1.0)).y, opponentFromLinear(glm::dvec3(1.0)).z)),
                0.0, 1e-12);
}

} // namespace
} // namespace tessera::validation
