// Limit cases of the culling tests for light lists (shaders/shared/culling.h), which must still pass. fp32 represents
// all numbers exactly.
#include "shaders/shared/culling.h"

#include <cmath>

#include <gtest/gtest.h>

#include "renderer/culling/TileGrid.h"
#include "tests/support/Random.h"

namespace tessera {
namespace {

TEST(LightTouch, aTileIsExactlyTheCentresOfItsPixelsAndAllOfThemWithSeveralSamples) {
    const glm::vec4 rayFromPixel(0.25f, 0.5f, 3.0f, 2.0f);
    glm::uvec4 size(13u, 9u, 1u, 0u);
    const auto rays = [&](unsigned column, unsigned row) {
        return shared::tileRays(rayFromPixel, column, row, 4u, size);
    };
    // Tile (1, 0) has the columns 4 to 7 and the rows 5 to 8 from below.
    EXPECT_EQ(rays(1, 0),
              glm::vec4(0.25f * (4.5f - 3.0f), 0.25f * (7.5f - 3.0f), 0.5f * (5.5f - 2.0f), 0.5f * (8.5f - 2.0f)));
    // The last tile has one column and one row.
    EXPECT_EQ(rays(3, 2), glm::vec4(0.25f * 9.5f, 0.25f * 9.5f, 0.5f * -1.5f, 0.5f * -1.5f));
    size.z = 4u;
    EXPECT_EQ(rays(1, 0),
              glm::vec4(0.25f * (4.0f - 3.0f), 0.25f * (8.0f - 3.0f), 0.5f * (5.0f - 2.0f), 0.5f * (9.0f - 2.0f)));
}

TEST(LightTouch, aSphereThatJustMeetsAPlaneOfASlabTouchesIt) {
    // Planes through the eye with slopes -3/4 and 3/4: the distance to a plane is 4/5 of the lateral offset.
    const glm::vec2 rays(-0.75f, 0.75f), eyeAtOrigin(0.0f, 1.0f), orthographic(1.0f, 0.0f);
    const auto touches = [&](float across, const glm::vec2& spread) {
        return shared::sphereTouchesSlab(across, shared::spreadAt(4.0f, spread), 1.0f,
                                         shared::slabBetween(rays, spread));
    };
    for (const float side : {-1.0f, 1.0f}) {
        EXPECT_TRUE(touches(4.25f * side, eyeAtOrigin));
        EXPECT_FALSE(touches(4.375f * side, eyeAtOrigin));
        EXPECT_TRUE(touches(1.75f * side, orthographic));
        EXPECT_FALSE(touches(1.875f * side, orthographic));
    }
}

TEST(LightTouch, aSphereThatJustMeetsADepthTouchesIt) {
    const auto touches = [](float z, float radius, float nearMetres, float farMetres) {
        return shared::sphereTouchesDepths(glm::vec4(0.0f, 0.0f, z, radius), nearMetres, farMetres);
    };
    EXPECT_TRUE(touches(2.0f, 1.0f, 3.0f, 4.0f));
    EXPECT_TRUE(touches(5.0f, 1.0f, 3.0f, 4.0f));
    EXPECT_FALSE(touches(1.875f, 1.0f, 3.0f, 4.0f));
    EXPECT_FALSE(touches(5.125f, 1.0f, 3.0f, 4.0f));
    // At the origin of lighting space, where the rounding margin is 0 too.
    EXPECT_TRUE(touches(-1.0f, 1.0f, 0.0f, 1.0f));
    EXPECT_TRUE(touches(1.0f, 1.0f, -1.0f, 0.0f));
}

TEST(LightTouch, theDistanceOfAPointFromABoxIsThatOfTheNearestPoint) {
    const shared::CellBox box{glm::vec4(1, 2, 3, 0), glm::vec4(4, 6, 8, 0)};
    for (const auto& [at, squared] : {std::pair(glm::vec3(2, 3, 4), 0.0f),
                                      {{-1, 3, 4}, 4.0f},
                                      {{7, 3, 4}, 9.0f},
                                      {{2, 1, 4}, 1.0f},
                                      {{2, 10, 4}, 16.0f},
                                      {{2, 3, 0}, 9.0f},
                                      {{2, 3, 13}, 25.0f},
                                      {{0, 8, 10}, 9.0f}})
        EXPECT_EQ(shared::squaredDistance(at.x, at.y, at.z, box), squared) << at.x << ", " << at.y << ", " << at.z;
}

TEST(LightTouch, aConeTouchesBoxesWithinHalfADiagonal) {
    // A cone from the origin along +z with a half angle of 45 degrees.
    const float root = std::sqrt(0.5f);
    const shared::CullLight light{glm::vec4(0, 0, 0, 100), glm::vec4(0, 0, 0, root), glm::vec4(0, 0, 1, root)};
    const auto touches = [&](const glm::vec3& center, float halfSide) {
        return shared::coneTouchesBox(light, {glm::vec4(center - halfSide, 0.0f), glm::vec4(center + halfSide, 0.0f)});
    };
    EXPECT_TRUE(touches({0, 0, 8}, 0.25f));
    EXPECT_TRUE(touches({0, 0, 0.0625f}, 1e-3f)) << "a small box on the axis, near the apex";
    EXPECT_TRUE(touches({7.5f, 0, 8}, 1e-3f));
    EXPECT_FALSE(touches({8.5f, 0, 8}, 1e-3f));
    EXPECT_FALSE(touches({0, 0, -8}, 1.0f));
    // (9, 0, 8) is 1 / sqrt 2 = 0.707 away from the cone; a box's half diagonal is sqrt 3 times half its side.
    EXPECT_TRUE(touches({9, 0, 8}, 0.42f));
    EXPECT_FALSE(touches({9, 0, 8}, 0.4f));
}

TEST(LightTouch, aLightTouchesABoxExactlyWithinItsRadiusAndItsCone) {
    const shared::CellBox box{glm::vec4(1, 2, 3, 0), glm::vec4(4, 6, 8, 0)};
    const auto touches = [&](float radius, const glm::vec4& axis) { // three metres to the right of the box
        return shared::lightTouchesBox({glm::vec4(7, 3, 4, radius), glm::vec4(7, 3, 4, std::sqrt(0.5f)), axis}, box);
    };
    const glm::vec4 noCone(0, 0, 0, -2), left(-1, 0, 0, std::sqrt(0.5f)), right(1, 0, 0, std::sqrt(0.5f));
    const glm::vec4 frontLeft(-1, 0, 0, -3), frontRight(1, 0, 0, -3);
    for (const glm::vec4& axis : {noCone, left, frontLeft}) {
        EXPECT_TRUE(touches(3.0f, axis)) << axis.w;
        EXPECT_FALSE(touches(2.875f, axis)) << axis.w;
    }
    for (const glm::vec4& axis : {right, frontRight}) EXPECT_FALSE(touches(3.0f, axis)) << axis.w;
}

TEST(LightTouch, theFrontOfALightTouchesBoxesOfWhichAnyCornerLiesBeforeItsPlane) {
    test::Random random(11);
    int touched = 0;
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 normal(random.direction()), point(3.0 * random.direction());
        const glm::vec3 low(2.0 * random.direction());
        const glm::vec3 high =
            low + glm::vec3(random.between(0.1, 3.0), random.between(0.1, 3.0), random.between(0.1, 3.0));
        double farthest = -1e9;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 at(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z);
            farthest = std::max(farthest, glm::dot(glm::dvec3(normal), at - glm::dvec3(point)));
        }
        if (std::abs(farthest) < 1e-3) continue;
        const shared::CullLight light{glm::vec4(point, 100.0f), glm::vec4(point, 1.0f), glm::vec4(normal, -3.0f)};
        EXPECT_EQ(shared::frontTouchesBox(light, {glm::vec4(low, 0.0f), glm::vec4(high, 0.0f)}), farthest > 0.0);
        touched += farthest > 0.0 ? 1 : 0;
    }
    EXPECT_GT(touched, 300);
    EXPECT_LT(touched, 900);
}

TEST(LightTouch, theMarginForRoundingIsThatOfPositionsAndThatOfEvenDepthsTogether) {
    EXPECT_EQ(shared::roundingMargin(2.0f, {3.0f, 0.0f, 5.0f, 7.0f}), 2e-5f);
    EXPECT_EQ(shared::roundingMargin(0.0f, {3.0f, 0x1p21f, 5.0f, 7.0f}), 1.0f) << "eight times 2^-24 of 2^21 m";
    EXPECT_EQ(shared::roundingMargin(2.0f, {3.0f, 0x1p21f, 5.0f, 7.0f}), 2e-5f + 1.0f);
}

TEST(TileGrid, theFinestSlicesOfDepthAreAsDeepAsATileOfSixteenPixelsIsWide) {
    // 2^23 depth keys cover a factor of two in distance, or a uniform interval; a slice covers 2^shift keys. All
    // numbers are powers of two, so the slice depth is exact instead of the nearest power of two.
    const auto finestShift = [](float pixelMetres, bool orthographic, float originMetres, float evenMetres) {
        shared::ViewConstants view{};
        view.sizePixels = {640, 360, 0, 0};
        view.rayFromPixel.y = pixelMetres;
        view.forwardLS.w = orthographic ? 1.0f : 0.0f;
        view.eyeLS.w = originMetres;
        view.depthKey.y = evenMetres;
        shared::LightingConstants lighting{};
        culling::setTileGrid(lighting, view, 16);
        return lighting.slices.x;
    };
    EXPECT_EQ(finestShift(0x1p-8f, false, 0.0f, 0.0f), 23u - 4u) << "1/16 of the distance: 2^4 slices";
    EXPECT_EQ(finestShift(0x1p-8f, false, 1024.0f, 512.0f), 23u - 3u) << "64 m in the middle: 2^3 of 512 m";
    EXPECT_EQ(finestShift(0x1p-8f, true, 1024.0f, 512.0f), 23u - 13u) << "1/16 m everywhere: 2^13 of 512 m";
    EXPECT_EQ(finestShift(0x1p-16f, true, 0.0f, 0x1p-8f), 23u - 4u) << "1/4096 m: 2^4 of 4 mm";
    EXPECT_EQ(finestShift(0x1p-40f, false, 0.0f, 0.0f), 5u) << "what packSlices() has room for";
    EXPECT_EQ(finestShift(1.0f, false, 0.0f, 0.0f), 22u) << "two slices where tiles are wider";
}

} // namespace
} // namespace tessera
