#include "renderer/frame/UvAtlas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

namespace tessera::frame {
namespace {

using scenes::Mesh;

/// Adds a quadrilateral with texture coordinates at its corners.
void addQuad(Mesh& mesh, const std::array<glm::vec3, 4>& corners, const std::array<glm::vec2, 4>& texCoords) {
    const auto first = std::uint32_t(mesh.positionsOS.size());
    for (std::size_t i = 0; i < 4; ++i) {
        mesh.positionsOS.push_back(corners[i]);
        mesh.normalsOS.emplace_back(0.0f, 0.0f, 1.0f);
        mesh.texCoords[0].push_back(texCoords[i]);
    }
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + corner);
}

Mesh square() {
    Mesh mesh;
    addQuad(mesh, {glm::vec3(0, 0, 0), {2, 0, 0}, {2, 1, 0}, {0, 1, 0}},
            {glm::vec2(0.25f, 0.25f), {0.75f, 0.25f}, {0.75f, 0.75f}, {0.25f, 0.75f}});
    return mesh;
}

TEST(UvAtlas, aSquareCoversItsTexelsOnceAndHasItsSteps) {
    const UvAtlas atlas = makeUvAtlas(square(), glm::dmat4(1.0), 64, 0, 4);
    std::size_t covered = 0;
    for (const UvTexel& texel : atlas.texels) covered += texel.isCovered;
    EXPECT_EQ(covered, 32u * 32u);
    EXPECT_EQ(atlas.overlapping, 0.0);
    EXPECT_EQ(atlas.chartCount, 1u);
    for (const UvStep& step : atlas.steps) {
        EXPECT_NEAR(step.uMetres, 2.0 / 32.0, 1e-12);
        EXPECT_NEAR(step.vMetres, 1.0 / 32.0, 1e-12);
        EXPECT_NEAR(step.shear, 0.0, 1e-12);
    }
    const UvAtlas larger = makeUvAtlas(square(), glm::scale(glm::dmat4(1.0), glm::dvec3(3.0)), 64, 0, 4);
    EXPECT_NEAR(larger.steps[0].uMetres, 6.0 / 32.0, 1e-12);
}

TEST(UvAtlas, aLoneTriangleIsAChart) {
    Mesh mesh = square();
    mesh.indices.resize(3);
    const UvAtlas atlas = makeUvAtlas(mesh, glm::dmat4(1.0), 64, 0, 4);
    EXPECT_EQ(atlas.chartCount, 1u);
    EXPECT_EQ(atlas.at(40, 20).chart, 1);
}

TEST(UvAtlas, pastAnEdgeThatNothingSharesThePlaceIsMirrored) {
    const UvAtlas atlas = makeUvAtlas(square(), glm::dmat4(1.0), 64, 0, 4);
    for (int out = 1; out <= 4; ++out) {
        const UvTexel& left = atlas.at(16 - out, 30);
        EXPECT_EQ(left.chart, 1);
        EXPECT_FALSE(left.isCovered);
        EXPECT_NEAR(left.continued.x, 16.0 + out - 0.5, 1e-9);
        EXPECT_NEAR(left.continued.y, 30.5, 1e-9);
        const UvTexel& above = atlas.at(30, 47 + out);
        EXPECT_NEAR(above.continued.x, 30.5, 1e-9);
        EXPECT_NEAR(above.continued.y, 48.0 - out + 0.5, 1e-9);
    }
    EXPECT_EQ(atlas.at(11, 30).chart, 0) << "out of reach";
}

/// A tube whose only seam runs lengthwise, between u = 1 and u = 0.
Mesh tube(int sides) {
    Mesh mesh;
    for (int i = 0; i < sides; ++i) {
        const auto at = [&](int side, float y) {
            const double angle = 2.0 * std::numbers::pi * double(side % sides) / sides;
            return glm::vec3(std::cos(angle), y, std::sin(angle));
        };
        const float u0 = float(i) / float(sides), u1 = float(i + 1) / float(sides);
        addQuad(mesh, {at(i, 0), at(i, 1), at(i + 1, 1), at(i + 1, 0)}, {glm::vec2(u0, 0), {u0, 1}, {u1, 1}, {u1, 0}});
    }
    return mesh;
}

TEST(UvAtlas, acrossASeamTheSurfaceGoesOnAtItsOtherSide) {
    constexpr int kAtlasSide = 96, kBorder = 16;
    const UvAtlas atlas = makeUvAtlas(tube(8), glm::dmat4(1.0), kAtlasSide, kBorder, 8);
    EXPECT_EQ(atlas.chartCount, 1u);
    for (int out = 1; out <= 8; ++out) {
        const UvTexel& before = atlas.at(kBorder - out, 40);
        ASSERT_EQ(before.chart, 1);
        EXPECT_NEAR(before.continued.x, kAtlasSide - kBorder - out + 0.5, 1e-4) << out;
        EXPECT_NEAR(before.continued.y, 40.5, 1e-4);
        const UvTexel& behind = atlas.at(kAtlasSide - kBorder - 1 + out, 40);
        EXPECT_NEAR(behind.continued.x, kBorder + out - 0.5, 1e-4) << out;
    }
}

// Two squares folded at a common edge; the second one's texture is rotated, mirrored and of half the density.
TEST(UvAtlas, theOtherSideOfASeamMayBeTurnedMirroredAndOfAnotherDensity) {
    Mesh mesh;
    addQuad(mesh, {glm::vec3(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
            {glm::vec2(0, 0), {0.5f, 0}, {0.5f, 0.5f}, {0, 0.5f}});
    // Shares the edge from (1, 0, 0) to (1, 1, 0); y runs along -u there, and depth along v.
    addQuad(mesh, {glm::vec3(1, 0, 0), {1, 0, -1}, {1, 1, -1}, {1, 1, 0}},
            {glm::vec2(1, 0.75f), {1, 1}, {0.75f, 1}, {0.75f, 0.75f}});
    const UvAtlas atlas = makeUvAtlas(mesh, glm::dmat4(1.0), 128, 0, 6);
    EXPECT_EQ(atlas.chartCount, 2u);
    for (int out = 1; out <= 6; ++out) {
        const UvTexel& past = atlas.at(63 + out, 20);
        ASSERT_EQ(past.chart, 1);
        const double metres = (out - 0.5) / 64.0, y = 20.5 / 64.0;
        EXPECT_NEAR(past.continued.x, 128.0 - 32.0 * y, 1e-9);
        EXPECT_NEAR(past.continued.y, 96.0 + 32.0 * metres, 1e-9);
    }
    const UvTexel& back = atlas.at(110, 94);
    const double metres = (96.0 - 94.5) / 32.0, y = (128.0 - 110.5) / 32.0;
    EXPECT_NEAR(back.continued.x, 64.0 - 64.0 * metres, 1e-9);
    EXPECT_NEAR(back.continued.y, 64.0 * y, 1e-9);
}

TEST(UvAtlas, stepsOfASkewedTextureAreAtRightAnglesOnTheSurface) {
    Mesh mesh;
    addQuad(mesh, {glm::vec3(0, 0, 0), {3, 0, 0}, {4, 2, 0}, {1, 2, 0}}, {glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 1}});
    const UvAtlas atlas = makeUvAtlas(mesh, glm::dmat4(1.0), 10, 0, 0);
    for (const UvStep& step : atlas.steps) {
        EXPECT_NEAR(step.uMetres, 0.3, 1e-7);
        EXPECT_NEAR(step.vMetres, 0.2, 1e-7);
        EXPECT_NEAR(step.shear, -1.0 / 3.0, 1e-6); // a row shifts by 0.1 m along u
    }
}

TEST(UvAtlas, aMeshWithoutDiffusionIsRefusedWithAReason) {
    EXPECT_EQ(unwrapProblem(square()), "");
    EXPECT_EQ(unwrapProblem(tube(8)), "");
    Mesh bare = square();
    bare.texCoords[0].clear();
    EXPECT_EQ(unwrapProblem(bare), "it has no texture coordinates; unwrap it");
    Mesh tiled = square();
    tiled.texCoords[0][2] = {4.0f, 0.75f};
    EXPECT_EQ(unwrapProblem(tiled), "its texture coordinates go to 4, 0.75; unwrap it into 0 to 1");
    Mesh flat = square();
    for (glm::vec2& texCoord : flat.texCoords[0]) texCoord.y = 0.5f;
    EXPECT_EQ(unwrapProblem(flat),
              "no triangle has an area both in space and in its texture; unwrap it, or remove triangles of no size");
    Mesh mirrored = square();
    addQuad(mirrored, {glm::vec3(0, 0, 0), {-2, 0, 0}, {-2, 1, 0}, {0, 1, 0}},
            {glm::vec2(0.25f, 0.25f), {0.75f, 0.25f}, {0.75f, 0.75f}, {0.25f, 0.75f}});
    EXPECT_EQ(unwrapProblem(mirrored),
              "several of its triangles lie in 100 % of its texture; unwrap it so that none overlap");
}

/// Charts that overlap in two hundredths of the texels are refused, those that overlap in half a hundredth are not.
TEST(UvAtlas, aHundredthOfItsTexelsMayOverlap) {
    const auto halves = [](float overlap) {
        Mesh mesh = square();
        mesh.texCoords[0] = {{0, 0}, {0.5f + overlap, 0}, {0.5f + overlap, 1}, {0, 1}};
        addQuad(mesh, {glm::vec3(5, 0, 0), {7, 0, 0}, {7, 1, 0}, {5, 1, 0}},
                {glm::vec2(0.5f, 0), {1, 0}, {1, 1}, {0.5f, 1}});
        return mesh;
    };
    EXPECT_EQ(unwrapProblem(halves(0.005f)), "");
    EXPECT_EQ(unwrapProblem(halves(0.02f)),
              "several of its triangles lie in 2 % of its texture; unwrap it so that none overlap");
}

/// Exporters round the coordinates on both sides of an edge independently. Strips that overlap by their last digit
/// alone, at the centres of a quarter of all texels, are accepted; an overlap of a texel is refused.
TEST(UvAtlas, stripsThatMeetToTheLastDigitDoNotOverlap) {
    const auto strips = [](float further) {
        Mesh mesh;
        for (int i = 0; i < 40; ++i) {
            const float left = (4.0f * float(i) + 0.5f) / 1024.0f, right = left + 4.0f / 1024.0f;
            const float u0 = std::nextafter(left, 0.0f) - further, u1 = std::nextafter(right, 1.0f) + further;
            addQuad(mesh, {glm::vec3(left, 0, 0), {right, 0, 0}, {right, 1, 0}, {left, 1, 0}},
                    {glm::vec2(std::max(u0, 0.0f), 0), {u1, 0}, {u1, 1}, {std::max(u0, 0.0f), 1}});
        }
        return mesh;
    };
    EXPECT_EQ(unwrapProblem(strips(0.0f)), "");
    EXPECT_NE(unwrapProblem(strips(0.5f / 1024.0f)), "");
}

TEST(UvAtlas, trianglesWithoutAreaAndAnAtlasOfOneTexelHarmNothing) {
    Mesh mesh = square();
    for (const std::uint32_t corner : {0u, 0u, 1u, 0u, 1u, 1u}) mesh.indices.push_back(corner);
    const UvAtlas atlas = makeUvAtlas(mesh, glm::dmat4(1.0), 64, 0, 4);
    EXPECT_EQ(atlas.chartCount, 1u);
    EXPECT_EQ(atlas.steps[2].uMetres, 0.0);
    const UvAtlas tiny = makeUvAtlas(mesh, glm::dmat4(1.0), 1, 0, 1);
    EXPECT_EQ(tiny.texels.size(), 1u);
    EXPECT_TRUE(tiny.at(0, 0).isCovered);
}

} // namespace
} // namespace tessera::frame
