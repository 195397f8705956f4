#include "validation/reference/Filtering.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "validation/reference/LookupTolerance.h"

namespace tessera::reference {
namespace {

using scenes::Filter;
using scenes::Image;
using scenes::Wrap;

/// Grey: value(column, row) of 0..255.
Image grey(int width, int height, const std::function<int(int, int)>& value) {
    Image image;
    image.width = width;
    image.height = height;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const int channel : {value(x, y), value(x, y), value(x, y), 255})
                image.texels.push_back(std::byte(channel));
    return image;
}

Image ramp(int width) {
    return grey(width, 1, [](int x, int) { return 10 * x; });
}

constexpr double kMagnified = -std::numeric_limits<double>::infinity();

TEST(ReferencePyramid, aCheckerboardIsHalfBrightInLinearLight) {
    const Image board = grey(4, 4, [](int x, int y) { return (x + y) % 2 * 255; });
    for (const Transfer transfer : {Transfer::Linear, Transfer::Srgb}) {
        const Pyramid pyramid(board, transfer, true);
        ASSERT_EQ(pyramid.smallestLevel(), 2);
        EXPECT_EQ(pyramid.sizeTexels(1), glm::ivec2(2));
        for (const int level : {1, 2}) EXPECT_DOUBLE_EQ(pyramid.texel(level, 0, 0).r, 0.5);
    }
    EXPECT_EQ(Pyramid(board, Transfer::Linear, false).smallestLevel(), 0);
}

TEST(ReferencePyramid, oddSizesWeighTexelsByTheAreaThatIsCovered) {
    const Image image = ramp(5);
    const Pyramid pyramid(image, Transfer::Linear, true);
    ASSERT_EQ(pyramid.smallestLevel(), 2);
    ASSERT_EQ(pyramid.sizeTexels(1), glm::ivec2(2, 1));
    EXPECT_NEAR(pyramid.texel(1, 0, 0).r * 255.0, (0.0 + 10.0 + 0.5 * 20.0) / 2.5, 1e-5);
    EXPECT_NEAR(pyramid.texel(1, 1, 0).r * 255.0, (0.5 * 20.0 + 30.0 + 40.0) / 2.5, 1e-5);
    EXPECT_NEAR(pyramid.texel(2, 0, 0).r * 255.0, 20.0, 1e-5);
}

/// The mean of a linear slope over a texel is its value at the centre, at every level.
TEST(ReferenceFiltering, anEvenSlopeIsTheSameAtEveryLevel) {
    const Image image = ramp(16);
    const Pyramid pyramid(image, Transfer::Linear, true);
    const scenes::Sampler sampler{Filter::Linear, Filter::LinearMipmapLinear, Wrap::ClampToEdge, Wrap::ClampToEdge};
    for (const double level : {kMagnified, 0.0, 0.3, 1.0, 1.75}) {
        const double texels = 16.0 * 0.4;
        EXPECT_NEAR(filtered(pyramid, sampler, {0.4, 0.5}, level, 0.0).r * 255.0, 10.0 * (texels - 0.5), 1e-4) << level;
    }
    EXPECT_NEAR(filtered(pyramid, sampler, {0.4, 0.5}, 9.0, 0.0).r * 255.0, 75.0, 1e-4)
        << "the smallest level is the mean";
}

/// OpenGL 4.5 core, equations 8.6 and 8.8.
TEST(ReferenceFiltering, theLevelIsTheLogarithmOfTheLongerSideInTexels) {
    const double turn = 0.4;
    const Footprint footprint{
        {0, 0}, 0.25 * glm::dvec2(std::cos(turn), std::sin(turn)), 0.5 * glm::dvec2(-std::sin(turn), std::cos(turn))};
    EXPECT_NEAR(levelOf(footprint, {16, 16}), 3.0, 1e-12);
    EXPECT_NEAR(finestLevelOf(footprint, {16, 16}), 3.0 + std::log2(std::cos(turn)), 1e-12);
    EXPECT_NEAR(levelOf({{0, 0}, {0.25, 0}, {0, 0.25}}, {4, 64}), 4.0, 1e-12);
    EXPECT_EQ(levelOf({}, {16, 16}), kMagnified);
}

/// A driver may take the finest level that OpenGL allows, and one level for a block of 2x2 pixels, over which the
/// footprint grows by twice its relative change.
TEST(ReferenceFiltering, theLevelMayBeTheFinestOneAndThatOfANeighbour) {
    const double turn = 0.4, change = 1e-4;
    const Footprint footprint{{0, 0}, 0.25 * glm::dvec2(std::cos(turn), std::sin(turn)), {}};
    const Image image = grey(16, 16, [](int, int) { return 0; });
    const Pyramid pyramid(image, Transfer::Linear, true);
    const auto tolerance = [&](double perspective) {
        Hit hit;
        hit.perspective = perspective;
        return lookupTolerance(Filtering::Hardware, {}, footprint, pyramid, hit);
    };
    EXPECT_NEAR(tolerance(0.0).finer - tolerance(0.0).coarser, -std::log2(std::cos(turn)), 1e-12);
    EXPECT_NEAR(tolerance(change).finer - tolerance(0.0).finer, std::log2(1.0 + 2.0 * change), 1e-7);
    EXPECT_NEAR(tolerance(change).coarser - tolerance(0.0).coarser, std::log2(1.0 + 2.0 * change), 1e-7);
}

/// The levels that are read, and their weights: all levels of a checkerboard but the first are uniform.
TEST(ReferenceFiltering, everyFilterTakesTheLevelsOfTheSpecification) {
    const Image image = grey(8, 8, [](int x, int y) { return (x + y) % 2 * 200; });
    const Pyramid pyramid(image, Transfer::Linear, true);
    const double nearestTexel = 0.0, mean = 100.0; // level 0 at the centre of texel (0, 0), and every smaller one
    struct Row {
        Filter magnification, minification;
        double level, wanted;
    };
    const Row rows[] = {
        {Filter::Linear, Filter::Nearest, 7.0, nearestTexel},
        {Filter::Linear, Filter::Linear, 7.0, nearestTexel},
        {Filter::Nearest, Filter::NearestMipmapNearest, 0.5, nearestTexel},
        {Filter::Nearest, Filter::NearestMipmapNearest, 0.51, mean},
        {Filter::Nearest, Filter::LinearMipmapNearest, 0.5, nearestTexel},
        {Filter::Nearest, Filter::LinearMipmapNearest, 0.51, mean},
        {Filter::Nearest, Filter::NearestMipmapLinear, 0.25, 0.25 * mean},
        {Filter::Nearest, Filter::LinearMipmapLinear, 0.25, 0.25 * mean},
        {Filter::Nearest, Filter::LinearMipmapLinear, 1.75, mean},
        {Filter::Nearest, Filter::LinearMipmapLinear, 50.0, mean},
        // Linear magnification extends to half a level where minification takes single texels of levels.
        {Filter::Linear, Filter::NearestMipmapLinear, 0.5, nearestTexel},
        {Filter::Linear, Filter::NearestMipmapLinear, 0.75, 0.75 * mean},
    };
    for (const Row& row : rows) {
        const scenes::Sampler sampler{row.magnification, row.minification, Wrap::Repeat, Wrap::Repeat};
        EXPECT_NEAR(filtered(pyramid, sampler, {0.5 / 8, 0.5 / 8}, row.level, magnifiedUpTo(sampler)).r * 255.0,
                    row.wanted, 1e-5)
            << int(row.magnification) << ' ' << int(row.minification) << ' ' << row.level;
    }
}

TEST(ReferenceFiltering, magnificationAndMinificationHaveFiltersOfTheirOwn) {
    const Image image = ramp(8);
    const Pyramid pyramid(image, Transfer::Linear, false);
    const auto at = [&](Filter magnification, Filter minification, double level) {
        const scenes::Sampler sampler{magnification, minification, Wrap::Repeat, Wrap::Repeat};
        return filtered(pyramid, sampler, {3.75 / 8.0, 0.5}, level, magnifiedUpTo(sampler)).r *
               255.0; // a quarter from texel 3 to 4
    };
    EXPECT_NEAR(at(Filter::Nearest, Filter::Linear, -0.01), 30.0, 1e-9);
    EXPECT_NEAR(at(Filter::Nearest, Filter::Linear, 0.01), 32.5, 1e-9);
    EXPECT_NEAR(at(Filter::Linear, Filter::Nearest, 0.01), 30.0, 1e-9);
    EXPECT_NEAR(at(Filter::Linear, Filter::NearestMipmapLinear, 0.49), 32.5, 1e-9);
    EXPECT_NEAR(at(Filter::Linear, Filter::NearestMipmapLinear, 3.0), 30.0, 1e-9) << "one level has no other";
}

TEST(ReferenceFiltering, aCentreIsItsTexelAndBetweenTexelsWeightsAreLinear) {
    const Image image = grey(2, 2, [](int x, int y) { return 255 * x + 0 * y; });
    const Pyramid pyramid(image, Transfer::Linear, false);
    scenes::Sampler sampler;
    const auto at = [&](double u, double v) { return filtered(pyramid, sampler, {u, v}, kMagnified, 0.0).r; };
    EXPECT_EQ(at(0.25, 0.25), 0.0);
    EXPECT_EQ(at(0.75, 0.25), 1.0);
    EXPECT_DOUBLE_EQ(at(0.35, 0.25), 0.2);
    EXPECT_DOUBLE_EQ(at(0.0, 0.25), 0.5); // repeats
    EXPECT_TRUE(std::isfinite(at(1e30, -1e30)));
    sampler.wrapU = Wrap::ClampToEdge;
    EXPECT_EQ(at(0.0, 0.25), 0.0);
    sampler.wrapU = Wrap::MirroredRepeat;
    EXPECT_EQ(at(1.0, 0.25), 1.0);
    EXPECT_EQ(at(1.25, 0.25), 1.0);
    EXPECT_EQ(at(1.75, 0.25), 0.0);
    sampler.magnification = Filter::Nearest;
    EXPECT_EQ(at(0.499, 0.25), 0.0);
    EXPECT_EQ(at(0.5, 0.25), 1.0) << "a texel begins with its edge";
    EXPECT_EQ(at(1.499, 0.25), 1.0);
    EXPECT_EQ(at(1.5, 0.25), 0.0);
}

} // namespace
} // namespace tessera::reference
