#include <algorithm>
#include <cmath>
#include <utility>

#include <gmock/gmock.h>

#include "renderer/frame/Diffusion.h"
#include "renderer/frame/FrameSpec.h"
#include "scenes/Load.h"

namespace tessera {
namespace {

using frame::DiffusionLevel;

glm::dvec3 weightOf(const std::vector<DiffusionLevel>& levels) {
    glm::dvec3 sum(0.0);
    for (const DiffusionLevel& level : levels) sum += level.weight;
    return sum;
}

/// A texel width that resolves every Gaussian of skin.
constexpr double kTexelMetres = 1e-4;

/// Mean square of one coordinate of the diffusion distance, per channel.
glm::dvec3 meanSquare(const std::vector<DiffusionLevel>& levels) {
    double variance = frame::texelVariance(kTexelMetres, false);
    glm::dvec3 mean(0.0);
    for (const DiffusionLevel& level : levels) {
        variance += level.varianceSquareMetres;
        mean += level.weight * variance;
    }
    return mean;
}

TEST(DiffusionLevels, addTheProfilesGaussiansUp) {
    scenes::Subsurface skin;
    const std::vector<DiffusionLevel> levels = frame::diffusionKernel(skin, 8, 1e-4).levels;
    ASSERT_EQ(levels.size(), 6u);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(weightOf(levels)[c], 1.0, 1e-12);
    // Published variances in mm^2 and weights of red: d'Eon and Luebke 2007, GPU Gems 3, chapter 14.
    const double variances[] = {0.0064, 0.0484, 0.187, 0.567, 1.99, 7.41};
    const double red[] = {0.233, 0.100, 0.118, 0.113, 0.358, 0.078};
    double variance = frame::texelVariance(1e-4, false);
    for (std::size_t i = 0; i < 6; ++i) {
        variance += levels[i].varianceSquareMetres;
        EXPECT_NEAR(variance, 1e-6 * variances[i], 1e-12);
        EXPECT_NEAR(levels[i].weight.r, red[i], 2e-3);
    }
    skin.scaleMetres = 0.1f; // a model at ten times its real size
    EXPECT_NEAR(frame::diffusionKernel(skin, 8, 1e-4).levels[0].varianceSquareMetres, 6.4e-7 - 1e-8 / 6.0, 1e-12);
}

TEST(DiffusionLevels, fewerKeepTheLightAndHowFarItDiffusesOnTheMean) {
    const scenes::Subsurface skin;
    const glm::dvec3 whole = meanSquare(frame::diffusionKernel(skin, 8, kTexelMetres).levels);
    // All channels share the widths, so red, which diffuses farthest, passes some variance to the others. Figures from
    // the published numbers alone.
    for (const auto& [most, redShare] : {std::pair(5, 0.9972), {4, 0.9844}, {3, 0.9645}, {2, 0.4904}, {1, 0.3557}}) {
        const std::vector<DiffusionLevel> levels = frame::diffusionKernel(skin, most, kTexelMetres).levels;
        EXPECT_EQ(levels.size(), std::size_t(most));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(weightOf(levels)[c], 1.0, 1e-12);
        const glm::dvec3 own = meanSquare(levels);
        EXPECT_NEAR(own.r / whole.r, redShare, 5e-4) << most;
        EXPECT_NEAR(own.r + own.g + own.b, whole.r + whole.g + whole.b, 1e-9 * whole.r) << most;
        for (const DiffusionLevel& level : levels) EXPECT_GT(level.varianceSquareMetres, 0.0);
    }
}

TEST(DiffusionLevels, gaussiansNarrowerThanTexelsKeepTheirVarianceInTwoShares) {
    scenes::Subsurface narrow;
    narrow.profile = {{0.05f, glm::vec3(0.25f)}, {0.1f, glm::vec3(0.75f)}}; // square millimetres
    for (const bool isHalved : {false, true}) {
        const frame::DiffusionKernel kernel = frame::diffusionKernel(narrow, 8, 1e-3, isHalved);
        const double shown = frame::texelVariance(1e-3, isHalved);
        EXPECT_TRUE(kernel.levels.empty());
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(kernel.inTexels[c] * shown, 0.25 * 0.05e-6 + 0.75 * 0.1e-6, 1e-14);
            EXPECT_NEAR(kernel.inTexels[c] + kernel.inPixels[c], 1.0, 1e-12);
        }
    }
    const scenes::Subsurface skin;
    EXPECT_NEAR(frame::diffusionKernel(skin, 8, 1.0).inPixels.r, 1.0, 1e-4) << "texels far wider than all";
    const frame::DiffusionKernel exact = frame::diffusionKernel(skin, 8, 0.0);
    EXPECT_EQ(exact.levels.size(), 6u) << "an object without area";
    EXPECT_EQ(exact.inPixels, glm::dvec3(0.0));
}

TEST(DiffusionLevels, wideJumpsHaveStepsBetween) {
    scenes::Subsurface wide;
    wide.profile = {{1e6f, glm::vec3(1.0f)}}; // a metre
    const double texelMetres = 1e-3;
    const std::vector<DiffusionLevel> levels = frame::diffusionKernel(wide, 8, texelMetres).levels;
    EXPECT_GT(levels.size(), 3u);
    double variance = frame::texelVariance(texelMetres, false);
    for (const DiffusionLevel& level : levels) {
        const double before = std::exchange(variance, variance + level.varianceSquareMetres);
        if (variance > 4.0 * before) {
            EXPECT_LE(3.5 * std::sqrt(level.varianceSquareMetres), 64.0 * texelMetres + 1e-12)
                << "every texel is a tap";
        }
    }
    EXPECT_NEAR(variance, 1.0, 1e-6);
    EXPECT_EQ(levels.back().weight, glm::dvec3(1.0));
    EXPECT_EQ(weightOf(levels), glm::dvec3(1.0));
    // The result of a narrow Gaussian is not smooth at the width of a wide one.
    wide.profile = {{0.5f, glm::vec3(0.05f)}, {320.0f, glm::vec3(0.95f)}}; // 0.71 and 17.9 mm
    const std::vector<DiffusionLevel> two = frame::diffusionKernel(wide, 8, texelMetres).levels;
    EXPECT_EQ(two.size(), 2u) << "every texel is a tap of both";
}

/// A square of skin with sides of a metre, whose texture coordinates 0 to 1 cover the texels within the border.
TEST(DiffusionSpec, measuresTexelsWhereTheAtlasLaysThem) {
    const scenes::Scene scene = scenes::loadScene("diffusion_truth");
    const std::vector<frame::DiffusionObject> objects = frame::diffusionObjects(scene, {}, frame::surfaceBounds(scene));
    ASSERT_FALSE(objects.empty());
    const scenes::Subsurface& skin = scene.materials[std::size_t(objects[0].material)].subsurface;
    for (const int side : {256, 512, 1024, 2048}) {
        for (const bool isHalved : {false, true}) {
            frame::FrameSettings settings;
            settings.diffusion = {side, 8, isHalved};
            const frame::FrameSpec spec = frame::makeDiffusionSpec(scene, objects[0], {}, settings);
            frame::UvAtlas atlas;
            atlas.sideTexels = spec.diffusionTexels();
            atlas.borderTexels = frame::borderTexels(spec.gutterTexels, spec.diffusionTexels());
            EXPECT_GT(atlas.borderTexels, 0);
            const double texelMetres = 1.0 / (atlas.placeOf({1.0f, 0.0f}).x - atlas.placeOf({0.0f, 0.0f}).x);
            const double shown = frame::texelVariance(texelMetres, isHalved);
            // The narrowest Gaussian that is wider than a texel's filter.
            const double millimetre = 1e-3 / double(skin.scaleMetres);
            double variance = 0.0;
            for (const scenes::DiffusionGaussian& gaussian : scenes::profileOf(skin)) {
                variance = double(gaussian.varianceSquareMillimetres) * millimetre * millimetre;
                if (variance > shown) break;
            }
            const DiffusionLevel& first = spec.diffusionKernel->levels.at(0);
            EXPECT_NEAR(first.varianceSquareMetres, variance - shown, 1e-6 * variance) << side;
            EXPECT_NEAR(first.totalSquareMetres, variance, 1e-6 * variance) << side;
            EXPECT_NEAR(spec.diffusionKernel->texelMetres, texelMetres, 1e-6 * texelMetres) << side;
        }
    }
}

/// The first level diffuses all but the variance of a texel; each further level continues from the previous one.
TEST(DiffusionLevels, reachFromOneWidthToTheNext) {
    const frame::DiffusionKernel kernel = frame::diffusionKernel(scenes::Subsurface{}, 8, kTexelMetres);
    double before = 0.0;
    for (std::size_t i = 0; i < kernel.levels.size(); ++i) {
        const frame::LevelReach reach = frame::levelReach(kernel, i);
        EXPECT_EQ(reach.fromSquareMetres, before);
        EXPECT_NEAR(reach.toSquareMetres - std::max(before, frame::texelVariance(kTexelMetres, false)),
                    kernel.levels[i].varianceSquareMetres, 1e-20);
        before = reach.toSquareMetres;
    }
    EXPECT_NEAR(before, 7.41e-6, 1e-12);
}

} // namespace
} // namespace tessera
