#include "viewer/edit/Contour.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include <gtest/gtest.h>

namespace tessera::viewer {
namespace {

/// Contours of an image whose inside is where `isInside` holds.
template <typename IsInside>
std::vector<Contour> contoursWhere(glm::ivec2 size, const IsInside& isInside) {
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) pixels.push_back(isInside(x, y) ? 1 : 0);
    return contoursOf(pixels, size);
}

TEST(Contours, aRectangleHasItsFourCorners) {
    const auto contours = contoursWhere({20, 10}, [](int x, int y) { return x >= 3 && x < 12 && y >= 2 && y < 7; });
    ASSERT_EQ(contours.size(), 1u);
    const Contour& contour = contours[0];
    EXPECT_EQ(contour.size(), 5u);
    EXPECT_EQ(contour.front(), contour.back());
    for (const glm::vec2& corner : {glm::vec2(3, 2), glm::vec2(12, 2), glm::vec2(12, 7), glm::vec2(3, 7)})
        EXPECT_EQ(std::ranges::count(Contour(contour.begin() + 1, contour.end()), corner), 1);
}

TEST(Contours, aDiscIsRoundToWithinAPixelAndHasFewPoints) {
    const glm::vec2 middle(60.0f, 50.0f);
    const auto contours =
        contoursWhere({120, 100}, [&](int x, int y) { return glm::distance(glm::vec2(x, y) + 0.5f, middle) < 40.0f; });
    ASSERT_EQ(contours.size(), 1u);
    EXPECT_LT(contours[0].size(), 60u);
    EXPECT_GT(contours[0].size(), 12u);
    for (const glm::vec2& place : contours[0]) EXPECT_NEAR(glm::distance(place, middle), 40.0f, 1.0f);
}

TEST(Contours, thePicturesOwnSidesAreNone) {
    EXPECT_TRUE(contoursWhere({8, 6}, [](int, int) { return true; }).empty());
    EXPECT_TRUE(contoursWhere({8, 6}, [](int, int) { return false; }).empty());
    EXPECT_TRUE(contoursWhere({1, 1}, [](int, int) { return true; }).empty());
    const auto half = contoursWhere({8, 6}, [](int x, int) { return x < 3; });
    ASSERT_EQ(half.size(), 1u);
    ASSERT_EQ(half[0].size(), 2u) << "a line from side to side";
    EXPECT_EQ(half[0].front().x, 3.0f);
    EXPECT_EQ(half[0].back().x, 3.0f);
    EXPECT_EQ(std::abs(half[0].back().y - half[0].front().y), 6.0f);
    const auto corner = contoursWhere({8, 6}, [](int x, int y) { return x < 3 && y < 2; });
    ASSERT_EQ(corner.size(), 1u);
    EXPECT_EQ(corner[0].size(), 3u);
}

TEST(Contours, holesHaveTheirOwnAndWherePixelsTouchAtACornerNoneOfTheirCornersIsLost) {
    const auto ring = contoursWhere({20, 20}, [](int x, int y) {
        const bool isHole = x >= 8 && x < 12 && y >= 8 && y < 12;
        return x >= 2 && x < 18 && y >= 2 && y < 18 && !isHole;
    });
    ASSERT_EQ(ring.size(), 2u);
    EXPECT_GT(glm::distance(ring[0][0], ring[0][1]), glm::distance(ring[1][0], ring[1][1])) << "the longest first";
    const auto touching = contoursWhere({20, 20}, [](int x, int y) {
        return (x >= 2 && x < 10 && y >= 2 && y < 10) || (x >= 10 && x < 18 && y >= 10 && y < 18);
    });
    // One contour twice through the corner, or two.
    const auto timesAt = [&](const glm::vec2& corner) {
        std::ptrdiff_t times = 0;
        for (const Contour& contour : touching) {
            EXPECT_EQ(contour.front(), contour.back());
            times += std::count(contour.begin() + 1, contour.end(), corner);
        }
        return times;
    };
    EXPECT_EQ(timesAt({10, 10}), 2);
    for (const glm::vec2& corner :
         {glm::vec2(2, 2), glm::vec2(10, 2), glm::vec2(2, 10), glm::vec2(18, 10), glm::vec2(18, 18), glm::vec2(10, 18)})
        EXPECT_EQ(timesAt(corner), 1) << corner.x << ", " << corner.y;
}

TEST(Contours, ofTooManyTheLongestStay) {
    const auto contours = contoursWhere({600, 600}, [](int x, int y) {
        const bool isLarge = x >= 100 && x < 500 && y >= 100 && y < 500;
        return isLarge || (!(x >= 98 && x < 502 && y >= 98 && y < 502) && x % 3 == 1 && y % 3 == 1);
    });
    std::size_t points = 0;
    for (const Contour& contour : contours) points += contour.size();
    EXPECT_LE(points, kMostContourPoints);
    EXPECT_GT(points, kMostContourPoints / 2);
    EXPECT_EQ(glm::distance(contours.at(0)[0], contours.at(0)[1]), 400.0f);
}

/// Expects a comb of this many columns to keep its width; teeth and gaps are two columns each.
void expectCombStays(int columns) {
    constexpr int kDeep = 8;
    const auto comb = [](int x, int y) { return y >= 1 && y < 3 + (x / 2 % 2) * kDeep; };
    const auto contours = contoursWhere({columns, 20}, comb);
    ASSERT_EQ(contours.size(), 2u) << "above the comb and below it";
    std::size_t points = 0;
    for (const Contour& contour : contours) {
        points += contour.size();
        EXPECT_EQ(std::abs(contour.back().x - contour.front().x), float(columns));
    }
    EXPECT_LE(points, kMostContourPoints);
}

/// The farthest point of a comb is the first tooth, then the next one, and so on. Visiting all remaining points each
/// time would visit 2e10 points, for minutes. Linear work takes a few hundredths of a second.
TEST(Contours, theLongestStayAndTheTimeGrowsWithThePointsWhateverTheyAre) {
    const std::clock_t begin = std::clock();
    for (const int columns : {4200, 200'000}) expectCombStays(columns);
    EXPECT_LT(double(std::clock() - begin) / CLOCKS_PER_SEC, 5.0);
}

} // namespace
} // namespace tessera::viewer
