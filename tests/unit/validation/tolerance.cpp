#include "validation/figures/Tolerance.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "tests/unit/validation/Samples.h"
#include "validation/compare/CompareRecord.h"

namespace tessera::validation {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Verdict verdictOf(const Picture& a, const Picture& b, const Tolerance& tolerance = {}) {
    return checkTolerance(errorFigures(a, b), tolerance);
}

TEST(Tolerance, twoBlackPicturesNeverPass) {
    const Picture black = greyPicture(4, 4, 0.f);
    const Verdict verdict = verdictOf(black, black, {.bitEqual = 1.0});
    EXPECT_FALSE(verdict.ok);
    EXPECT_THAT(verdict.missed, ElementsAre("no signal: picture a is black (mean luminance 0)",
                                            "no signal: picture b is black (mean luminance 0)"));
}

TEST(Tolerance, aPairThatIsNotBitEqualNeverPassesWhereUnderATenthOfItsCoveredPixelsAreLit) {
    std::vector<Rgb> colours(100, Rgb{0, 0, 0});
    for (std::size_t i = 0; i < 9; ++i) colours[i] = {1, 1, 1};
    const Picture dim = pictureOf(10, 10, colours);
    Picture other = dim;
    setPixel(other, 0, {1.5f, 1, 1});
    EXPECT_THAT(verdictOf(other, dim).missed,
                ElementsAre(HasSubstr("only 9 % of the covered pixels of picture a are"),
                            HasSubstr("only 9 % of the covered pixels of picture b are")));
    setPixel(other, 9, {1, 1, 1});
    colours[9] = {1, 1, 1};
    EXPECT_TRUE(verdictOf(other, pictureOf(10, 10, colours)).ok);
}

TEST(Tolerance, theSignalIsCountedOverCoveredPixels) {
    // Ten covered pixels of a hundred; a bright background is not compared.
    Picture small = greyPicture(10, 10, 0.f);
    small.covered.assign(100, 0);
    for (std::size_t i = 0; i < 10; ++i) {
        small.covered[i] = 1;
        setPixel(small, i, {1, 1, 1});
    }
    Picture other = small;
    setPixel(other, 0, {1.5f, 1, 1});
    EXPECT_TRUE(verdictOf(other, small).ok);
    Picture dark = greyPicture(10, 10, 1.f);
    dark.covered = small.covered;
    for (std::size_t i = 0; i < 10; ++i) setPixel(dark, i, {0, 0, 0});
    EXPECT_THAT(verdictOf(dark, dark).missed, ElementsAre("no signal: no covered pixel of picture a is lit",
                                                          "no signal: no covered pixel of picture b is lit"));
}

TEST(Tolerance, picturesEqualToTheLastBitPassWithOneLitPixel) {
    Picture picture = greyPicture(20, 20, 0.f);
    setPixel(picture, 7, {1e-3f, 0, 0});
    EXPECT_TRUE(verdictOf(picture, picture, {.maxRel = 0.0, .bitEqual = 1.0}).ok);
}

TEST(Tolerance, aPictureOfNothingNeverPasses) {
    Picture none = greyPicture(2, 2, 1.f);
    none.covered.assign(4, 0);
    EXPECT_FALSE(verdictOf(none, none).ok);
}

TEST(Tolerance, badPixelsNeverPassWhereverTheyAre) {
    Picture b = greyPicture(10, 1, 1.f);
    b.covered[9] = 0;
    for (std::size_t at : {std::size_t{0}, std::size_t{9}})
        for (float value : {std::nanf(""), std::numeric_limits<float>::infinity(), -1e-6f}) {
            Picture a = b;
            setPixel(a, at, {value, 1, 1});
            EXPECT_FALSE(verdictOf(a, b).ok) << "pixel " << at << " is " << value;
            EXPECT_FALSE(verdictOf(a, a).ok) << "pixel " << at << " of both is " << value;
        }
}

TEST(Tolerance, overFivePercentExcludedNeverPasses) {
    const Picture picture = greyPicture(20, 5, 1.f);
    std::vector<std::uint8_t> excluded(100, 0);
    for (std::size_t i = 0; i < 5; ++i) excluded[i] = 1;
    EXPECT_TRUE(checkTolerance(errorFigures(picture, picture, excluded), {}).ok);
    excluded[5] = 1;
    EXPECT_THAT(checkTolerance(errorFigures(picture, picture, excluded), {}).missed,
                ElementsAre("6 % of the covered pixels were excluded, at most 5 % may be; edges take a smaller "
                            "share of a larger picture, so give a larger --size"));
}

TEST(Tolerance, everyLimitIsCheckedExactlyAtItsValue) {
    const Picture b = greyPicture(2, 1, 1.f);
    Picture a = b;
    setPixel(a, 0, {0.5f, 0.5f, 0.5f});
    const ErrorFigures figures = errorFigures(a, b);
    // By hand: maxRel = p999Rel = 0.5, bitEqual = 0.5, relMse = 0.125 / 1.01, bias = -0.25.
    const auto passes = [&](const Tolerance& tolerance) { return checkTolerance(figures, tolerance).ok; };
    EXPECT_TRUE(passes({}));
    EXPECT_TRUE(passes({.maxRel = 0.5}));
    EXPECT_FALSE(passes({.maxRel = 0.499}));
    EXPECT_TRUE(passes({.bitEqual = 0.5}));
    EXPECT_FALSE(passes({.bitEqual = 0.501}));
    EXPECT_TRUE(passes({.relMse = 0.124}));
    EXPECT_FALSE(passes({.relMse = 0.123}));
    EXPECT_TRUE(passes({.p999Rel = 0.5}));
    EXPECT_FALSE(passes({.p999Rel = 0.499}));
    EXPECT_TRUE(passes({.bias = 0.2501}));
    EXPECT_FALSE(passes({.bias = 0.2499})); // the magnitude counts: the bias is negative
    // One pixel alone errs, so the noise is 0.25 as well.
    EXPECT_TRUE(passes({.bias = 0.0, .biasNoises = 1.001}));
    EXPECT_FALSE(passes({.bias = 0.0, .biasNoises = 0.999}));
    EXPECT_THAT(checkTolerance(figures, {.maxRel = 0.25, .bitEqual = 1.0}).missed,
                ElementsAre("maxRel is 0.5, at most 0.25 is required", "bitEqual is 0.5, at least 1 is required"));
}

TEST(Tolerance, aFigureThatCouldNotBeMeasuredNeverHolds) {
    ErrorFigures figures = errorFigures(greyPicture(1, 1, 1.f), greyPicture(1, 1, 1.f));
    figures.relMse = std::nan("");
    EXPECT_THAT(checkTolerance(figures, {.relMse = 1.0}).missed, ElementsAre("relMse could not be measured"));
    EXPECT_THAT(checkTolerance(figures, {}).missed, IsEmpty());
}

} // namespace
} // namespace tessera::validation
