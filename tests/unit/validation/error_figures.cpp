#include "validation/figures/ErrorFigures.h"

#include <cmath>
#include <limits>
#include <numeric>

#include <gmock/gmock.h>

#include "base/Error.h"
#include "tests/support/ErrorText.h"
#include "tests/unit/validation/Samples.h"
#include "validation/figures/Percentile.h"
#include "validation/figures/PixelErrors.h"

namespace tessera::validation {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();
// The figures are double sums of a few terms: only their last digits may differ from the closed form.
constexpr double kRounding = 1e-12;

TEST(Percentile, nearestRankIsTheValueAtTheRoundedUpRank) {
    std::vector<double> thousand(1000);
    std::iota(thousand.rbegin(), thousand.rend(), 1.0);
    EXPECT_EQ(nearestRank(thousand, 500), 500.0);
    EXPECT_EQ(nearestRank(thousand, 990), 990.0);
    EXPECT_EQ(nearestRank(thousand, 999), 999.0);
    EXPECT_EQ(nearestRank(thousand, 1000), 1000.0);
    EXPECT_EQ(nearestRank(thousand, 0), 1.0);
    std::vector<double> three = {7.0, 5.0, 6.0};
    EXPECT_EQ(nearestRank(three, 500), 6.0);
    EXPECT_EQ(nearestRank(three, 333), 5.0);
    EXPECT_EQ(nearestRank(three, 334), 6.0);
    EXPECT_EQ(nearestRank(three, 999), 7.0);
    std::vector<double> none;
    EXPECT_TRUE(std::isnan(nearestRank(none, 500)));
}

TEST(ErrorFigures, everyFigureIsExactlyTheHandComputedOne) {
    // Truth: greys 1, 2, 4; a is off by +0.5 in red of the first, by -1 in every channel of the third.
    const Picture b = pictureOf(3, 1, {{1, 1, 1}, {2, 2, 2}, {4, 4, 4}});
    const Picture a = pictureOf(3, 1, {{1.5f, 1, 1}, {2, 2, 2}, {3, 3, 3}});
    const ErrorFigures figures = errorFigures(a, b);
    EXPECT_EQ(figures.covered, 3u);
    EXPECT_EQ(figures.compared, 3u);
    EXPECT_NEAR(figures.typicalLuminance, 2.0, kRounding); // all three are lit, the median is the second
    EXPECT_EQ(figures.maxAbs, 1.0);
    EXPECT_EQ(figures.maxRel, 0.5); // 0.5 / 1 against 1 / 4
    EXPECT_EQ(figures.worstX, 0u);
    EXPECT_EQ(figures.worstY, 0u);
    EXPECT_NEAR(figures.rmse, std::sqrt((0.25 + 3.0) / 9.0), kRounding);
    // 1e-2 m^2 = 0.04
    EXPECT_NEAR(figures.relMse, (0.25 / 1.04 + 3.0 / 16.04) / 9.0, kRounding);
    EXPECT_EQ(figures.p50Rel, 0.25);
    EXPECT_EQ(figures.p99Rel, 0.5);
    EXPECT_EQ(figures.p999Rel, 0.5);
    // luminance: a's sum is 1 + 0.2126 * 0.5 + 2 + 3, b's is 7
    EXPECT_NEAR(figures.bias, (6.1063 - 7.0) / 7.0, kRounding);
    EXPECT_NEAR(figures.biasNoise, std::sqrt(0.1063 * 0.1063 + 1.0) / 7.0, kRounding);
    EXPECT_NEAR(figures.bitEqual, 1.0 / 3.0, kRounding);
    EXPECT_NEAR(figures.meanLuminance, 7.0 / 3.0, kRounding);
    EXPECT_NEAR(figures.meanLuminanceA, 6.1063 / 3.0, kRounding);
    EXPECT_EQ(figures.litShare, 1.0);
    EXPECT_EQ(figures.excluded, 0.0);
    EXPECT_EQ(figures.bad.sum() + figures.badOutside.sum(), 0u);
}

TEST(ErrorFigures, darkTruthIsMeasuredAgainstAThousandthOfTheTypicalLuminance) {
    const Picture b = pictureOf(3, 1, {{0, 0, 0}, {2, 2, 2}, {2, 2, 2}});
    Picture a = b;
    setPixel(a, 0, {0.001f, 0, 0});
    const ErrorFigures figures = errorFigures(a, b);
    EXPECT_NEAR(figures.maxRel, double(0.001f) / 2e-3, kRounding);
}

TEST(ErrorFigures, litIsAboveATenThousandthOfTheTruthsHighPercentile) {
    const Picture b = pictureOf(4, 1, {{10, 10, 10}, {0.0009f, 0.0009f, 0.0009f}, {0.002f, 0.002f, 0.002f}, {0, 0, 0}});
    EXPECT_EQ(errorFigures(b, b).litShare, 0.5);
    EXPECT_NEAR(pixelErrors(b, b).litThreshold, 1e-3, kRounding);
    // m: the median, by nearest rank, of the two lit ones.
    EXPECT_NEAR(errorFigures(b, b).typicalLuminance, double(0.002f), kRounding);
}

TEST(ErrorFigures, bitEqualDistinguishesTheLastBitButNotTheSignOfZero) {
    Picture b = pictureOf(4, 1, {{1, 1, 1}, {0.f, 1, 1}, {1, 1, 1}, {1, 1, 1}});
    Picture a = b;
    setPixel(a, 1, {-0.f, 1, 1});
    setPixel(a, 3, {1, 1, std::nextafter(1.f, 2.f)});
    EXPECT_EQ(errorFigures(a, b).bitEqual, 0.75);
    EXPECT_EQ(errorFigures(a, b).bad.negative, 0u);
}

TEST(ErrorFigures, uncoveredPixelsNeverCountExceptInLitShareAndMeanLuminance) {
    Picture b = pictureOf(4, 1, {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {5, 5, 5}});
    Picture a = pictureOf(4, 1, {{1, 1, 1}, {1, 1, 1}, {1.5f, 1.5f, 1.5f}, {9, 9, 9}});
    a.covered = {1, 1, 1, 0};
    b.covered = {1, 1, 0, 0};
    const ErrorFigures figures = errorFigures(a, b);
    EXPECT_EQ(figures.covered, 3u); // covered in either
    EXPECT_EQ(figures.maxAbs, 0.5);
    EXPECT_NEAR(figures.bitEqual, 2.0 / 3.0, kRounding);
    EXPECT_NEAR(figures.meanLuminance, 2.0, kRounding);
    EXPECT_EQ(figures.litShare, 1.0);
}

TEST(ErrorFigures, excludedPixelsNeverCountAndTheirShareIsOfTheCoveredOnes) {
    Picture b = greyPicture(5, 1, 1.f);
    Picture a = b;
    setPixel(a, 1, {100, 100, 100});
    a.covered = b.covered = {1, 1, 1, 1, 0};
    const std::vector<std::uint8_t> excluded = {0, 1, 0, 0, 1};
    const ErrorFigures figures = errorFigures(a, b, excluded);
    EXPECT_EQ(figures.maxAbs, 0.0);
    EXPECT_EQ(figures.covered, 3u);
    EXPECT_EQ(figures.excluded, 0.25);
    EXPECT_EQ(figures.bitEqual, 1.0);
}

TEST(ErrorFigures, pixelsThatAreNotFiniteAreCountedAndNeverChangeTheOtherFigures) {
    const Picture b = pictureOf(4, 1, {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}});
    Picture a = b;
    setPixel(a, 0, {1.25f, 1, 1});
    setPixel(a, 2, {kNan, kInf, 3});
    setPixel(a, 3, {4, -kInf, 4});
    const ErrorFigures figures = errorFigures(a, b);
    EXPECT_EQ(figures.covered, 4u);
    EXPECT_EQ(figures.compared, 2u);
    EXPECT_EQ(figures.bad.nan, 1u);
    EXPECT_EQ(figures.bad.infinite, 2u);
    EXPECT_EQ(figures.bad.negative, 1u);
    EXPECT_EQ(figures.badA.sum(), 4u);
    EXPECT_EQ(figures.badB.sum(), 0u);
    EXPECT_EQ(figures.maxAbs, 0.25);
    EXPECT_EQ(figures.maxRel, 0.25);
    EXPECT_NEAR(figures.bias, 0.2126 * 0.25 / 3.0, kRounding);
    EXPECT_EQ(figures.bitEqual, 0.25);
    EXPECT_NEAR(figures.meanLuminance, 2.5, kRounding);
    EXPECT_NEAR(figures.meanLuminanceA, (3.0 + 0.2126 * 0.25) / 2.0, kRounding);
    EXPECT_EQ(figures.psnrReason, "infinite: the pictures are identical on an 8 bit display");
}

TEST(ErrorFigures, badPixelsOutsideTheCoveredOnesAreCountedApart) {
    Picture b = greyPicture(4, 1, 1.f);
    b.covered = {1, 1, 1, 0};
    Picture a = b;
    setPixel(a, 1, {kNan, 0, 0});
    setPixel(a, 3, {-1, 0, 0});
    const std::vector<std::uint8_t> excluded = {0, 1, 0, 0};
    const ErrorFigures figures = errorFigures(a, b, excluded);
    EXPECT_EQ(figures.bad.sum(), 0u);
    EXPECT_EQ(figures.badOutside.nan, 1u);
    EXPECT_EQ(figures.badOutside.negative, 1u);
}

TEST(ErrorFigures, figuresWithoutPixelsAreNotNumbers) {
    Picture none = greyPicture(2, 1, 1.f);
    none.covered = {0, 0};
    const Picture broken = pictureOf(1, 1, {{kNan, kNan, kNan}});
    for (const ErrorFigures& figures : {errorFigures(none, none), errorFigures(broken, broken)}) {
        for (double figure : {figures.maxAbs, figures.maxRel, figures.rmse, figures.relMse, figures.p50Rel,
                              figures.p99Rel, figures.p999Rel, figures.bias, figures.biasNoise})
            EXPECT_TRUE(std::isnan(figure));
        EXPECT_FALSE(figures.psnr.has_value());
        EXPECT_EQ(figures.psnrReason, "no pixel could be compared");
        EXPECT_FALSE(figures.flip.has_value());
        EXPECT_EQ(figures.flipReason, "no pixel could be compared");
    }
    EXPECT_TRUE(std::isnan(errorFigures(none, none).bitEqual));
    EXPECT_EQ(errorFigures(broken, broken).bitEqual, 1.0);
}

TEST(ErrorFigures, percentilesOfRelAreThoseOfTheWorstChannel) {
    const Picture b = greyPicture(1000, 1, 1.f);
    Picture a = b;
    for (std::size_t i = 0; i < 1000; ++i) setPixel(a, i, {1.f, 1.f + float(i) / 1024.f, 1.f});
    const ErrorFigures figures = errorFigures(a, b);
    EXPECT_EQ(figures.p50Rel, 499.0 / 1024.0);
    EXPECT_EQ(figures.p99Rel, 989.0 / 1024.0);
    EXPECT_EQ(figures.p999Rel, 998.0 / 1024.0);
    EXPECT_EQ(figures.maxRel, 999.0 / 1024.0);
    EXPECT_EQ(figures.worstX, 999u);
}

TEST(ErrorFigures, psnrIsOfTheClampedSrgbBytes) {
    // 2 and 1 display alike; linear 0 against 1 differs by 255 in each channel of half the pixels: 10 log10(2) dB.
    const Picture b = pictureOf(2, 1, {{1, 1, 1}, {1, 1, 1}});
    EXPECT_NEAR(errorFigures(pictureOf(2, 1, {{2, 2, 2}, {0, 0, 0}}), b).psnr.value(), 10.0 * std::log10(2.0),
                kRounding);
    const ErrorFigures clamped = errorFigures(pictureOf(2, 1, {{2, 2, 2}, {3, 3, 3}}), b);
    EXPECT_FALSE(clamped.psnr.has_value());
    EXPECT_EQ(clamped.psnrReason, "infinite: the pictures are identical on an 8 bit display");
    EXPECT_EQ(clamped.flip, 0.0);
}

TEST(ErrorFigures, flipIsTheMeanOverTheComparedPixelsAlone) {
    // Black against white: 0.967379 (FlipTest), wherever nothing is filtered across.
    const Picture b = greyPicture(8, 8, 0.f), a = greyPicture(8, 8, 1.f);
    EXPECT_NEAR(errorFigures(a, b).flip.value(), 0.967379, 1e-4);
    std::vector<std::uint8_t> excluded(64, 1);
    excluded[9] = 0;
    EXPECT_NEAR(errorFigures(a, b, excluded).flip.value(), 0.967379, 1e-4);
}

TEST(ErrorFigures, displayFiguresUseTheDisplayPictures) {
    const Picture b = greyPicture(4, 4, 1.f), a = greyPicture(4, 4, 2.f);
    EXPECT_EQ(errorFigures(a, b).flip, 0.0); // both are white without exposure
    const DisplayImage black{4, 4, std::vector<std::uint8_t>(48, 0)}, white{4, 4, std::vector<std::uint8_t>(48, 255)};
    const ErrorFigures shown = errorFigures(a, b, {}, {&black, &white});
    EXPECT_NEAR(shown.flip.value(), 0.967379, 1e-4);
    EXPECT_EQ(shown.psnr, 0.0);
    EXPECT_EQ(shown.maxRel, 1.0);
}

TEST(ErrorFigures, picturesOfTwoSizesAreRefusedByName) {
    EXPECT_EQ(test::errorText<InputError>(
                  [] { requireSameSize(greyPicture(2, 1, 1), "forward", greyPicture(1, 2, 1), "x.exr"); }),
              "forward is 2x1 but x.exr is 1x2; pictures that are compared must be of one size");
}

} // namespace
} // namespace tessera::validation
