// Shadows of the reference: fractions of a sun's disk, the tolerance for ray noise, and masks of casters.
#include "validation/reference/Occlusion.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/TestScenes.h"
#include "validation/reference/Casters.h"

namespace tessera::reference {
namespace {

constexpr double kAngularRadius = 0.1;

/// A floor and, 1 m above it, a plate over x < `edge`. The floor is one triangle, because a second one might block
/// light at the edge between both.
scenes::Scene floorUnderPlate(double edge) {
    scenes::Scene scene = test::quadScene({});
    scene.nodes.push_back(scene.nodes[0]);
    scene.meshes.push_back(scene.meshes[0]);
    scene.meshes[1].indices = {0, 1, 2};
    scene.materials.push_back(scene.materials[0]);
    scene.nodes[0].instances[0] = {1, 1};
    scene.nodes[1].parentFromNode[3] = {edge - 1.0, 0.0, 1.0, 1.0};
    return scene;
}

/// The shadow at the floor's centre, under a sun straight above.
Occlusion::Answer shadowAtMiddle(double edge, int samples) {
    const scenes::Scene scene = floorUnderPlate(edge);
    const CameraRays rays(scene.cameras[0], {1, 1});
    const Objects objects(scene, rays);
    Hit hit;
    hit.object = &objects.opaque()[0];
    hit.weights = {0.5, 0.0, 0.5};
    const glm::dvec3 middleRWS = -glm::dvec3(scene.cameras[0].worldFromCamera[3]);
    ShiningLight sun;
    sun.light.type = scenes::LightType::Directional;
    sun.light.directionWS = {0.0, 0.0, -1.0};
    sun.light.angularRadiusRadians = float(kAngularRadius);
    sun.castsShadow = true;
    SurfacePoint surface;
    surface.normal = {0.0, 0.0, 1.0};
    Settings settings;
    settings.shadowSamples = samples;
    return Occlusion(scene, objects).of(sun, hit, surface, middleRWS, {0.0, 0.0, 1.0}, settings);
}

TEST(ReferenceOcclusion, aPlatesEdgeLeavesOfASunTheSegmentOfItsDisk) {
    for (const double place : {-0.8, -0.3, 0.2, 0.6}) { // in radii from the disk's middle
        const double wanted = (std::acos(place) - place * std::sqrt(1.0 - place * place)) / std::numbers::pi;
        EXPECT_NEAR(shadowAtMiddle(place * std::tan(kAngularRadius), 0).share, wanted, 2e-3) << place;
    }
}

/// The least count whose cumulative probability is at least 1 / `rarity`, for `samples` rays that each hit with this
/// chance: by summing the binomial distribution.
int rareCount(int samples, double chance, double rarity) {
    double below = 0.0;
    for (int count = 0;; ++count) {
        below += std::exp(std::lgamma(samples + 1.0) - std::lgamma(count + 1.0) - std::lgamma(samples - count + 1.0) +
                          count * std::log(chance) + (samples - count) * std::log1p(-chance));
        if (below >= 1.0 / rarity) return count;
    }
}

/// A result with a probability of 1 in 10^5 is allowed, one with 1 in 10^15 is not.
TEST(ReferenceOcclusion, theNoiseThatRaysAreGrantedIsThatOfTheBinomialDistribution) {
    for (const double place : {-0.6, -0.2, 0.4})
        for (const int samples : {256, 1024, 4096}) {
            const Occlusion::Answer found = shadowAtMiddle(place * std::tan(kAngularRadius), samples);
            ASSERT_FALSE(found.isUndecided) << place;
            const double usual = double(rareCount(samples, found.share, 1e5)) / samples;
            const double never = double(rareCount(samples, found.share, 1e15)) / samples;
            EXPECT_LT(found.least, usual) << place << ", " << samples;
            EXPECT_GT(found.least, never) << place << ", " << samples;
            const double usualAbove = 1.0 - double(rareCount(samples, 1.0 - found.share, 1e5)) / samples;
            const double neverAbove = 1.0 - double(rareCount(samples, 1.0 - found.share, 1e15)) / samples;
            EXPECT_GT(found.most, usualAbove) << place << ", " << samples;
            EXPECT_LT(found.most, neverAbove) << place << ", " << samples;
        }
}

/// Light at the floor's centre, from a point light or a sun; the plate extends to x = `edge`.
struct Lit {
    double edge = -0.5;
    glm::dvec3 toLight{0.0, 0.0, 1.0};
    double sunRadians = 0.0;
    double bodyRadiusMetres = 0.0; ///< of a surface that wraps light
    float opacity = 1.0f;          ///< of the plate, whose mask is cut at 1/2
    double lean = 0.0;             ///< of the normals at both ends of the floor's diagonal, outwards
    double roundingMetres = 0.0;   ///< of the floor's triangle
};
Occlusion::Answer shadowOf(const Lit& lit) {
    scenes::Scene scene = floorUnderPlate(lit.edge);
    scene.materials[0].alphaMode = scenes::AlphaMode::Mask;
    scene.materials[0].alphaCutoff = 0.5f;
    scene.materials[0].baseColor.a = lit.opacity;
    scene.meshes[0].colors.clear();
    if (lit.lean > 0.0)
        for (const std::size_t corner : {0u, 2u}) {
            const glm::dvec3 outwards = glm::normalize(glm::dvec3(scene.meshes[1].positionsOS[corner]));
            scene.meshes[1].normalsOS[corner] =
                std::sin(lit.lean) * outwards + glm::dvec3(0.0, 0.0, std::cos(lit.lean));
        }
    const CameraRays rays(scene.cameras[0], {1, 1});
    const Objects objects(scene, rays);
    Hit hit;
    hit.object = &objects.opaque()[0];
    hit.weights = {0.5, 0.0, 0.5};
    hit.roundingMetres = lit.roundingMetres;
    ShiningLight sun;
    sun.light.type = scenes::LightType::Directional;
    sun.light.directionWS = -glm::normalize(lit.toLight);
    sun.light.angularRadiusRadians = float(lit.sunRadians);
    sun.castsShadow = true;
    SurfacePoint surface;
    surface.normal = {0.0, 0.0, 1.0};
    if (lit.bodyRadiusMetres > 0.0) surface.wrap = glm::dvec3(0.5);
    surface.bodyRadiusMetres = lit.bodyRadiusMetres;
    return Occlusion(scene, objects)
        .of(sun, hit, surface, -glm::dvec3(scene.cameras[0].worldFromCamera[3]), {0.0, 0.0, 1.0}, {});
}

/// Positions within 3 m are rounded by up to 2e-7 m and summed a few times. The normal along which a program lifts a
/// point has 24 bits: at least 1e-6 of a body's radius.
TEST(ReferenceOcclusion, edgesAreUndecidedAsFarAsRoundingMovesThemAndNoFarther) {
    for (const double side : {1.0, -1.0}) {
        EXPECT_TRUE(shadowOf({.edge = side * 2e-7}).isUndecided);
        EXPECT_FALSE(shadowOf({.edge = side * 1e-4}).isUndecided);
        EXPECT_EQ(shadowOf({.edge = side * 1e-4}).share, side > 0.0 ? 0.0 : 1.0);
        EXPECT_TRUE(shadowOf({.edge = side * 1e-4, .bodyRadiusMetres = 100.0}).isUndecided);
        EXPECT_FALSE(shadowOf({.edge = side * 2e-3, .bodyRadiusMetres = 100.0}).isUndecided);
    }
}

/// A point that softened terminators lift moves by twice the rounding of its triangle, far more than by other roundings
/// here; one that is not lifted stays.
TEST(ReferenceOcclusion, liftedPointsAreUndecidedAsFarAsTheirTriangleIsRounded) {
    constexpr double kRounding = 0.01, kOthers = 1e-4;
    for (const double side : {1.0, -1.0}) {
        const auto isUndecided = [&](double metres, double lean) {
            return shadowOf({.edge = side * metres, .lean = lean, .roundingMetres = kRounding}).isUndecided;
        };
        EXPECT_TRUE(isUndecided(2.0 * kRounding, 0.02));
        EXPECT_FALSE(isUndecided(2.0 * kRounding + kOthers, 0.02));
        EXPECT_FALSE(isUndecided(kOthers, 0.0));
    }
}

/// A mask's opacity is a product of numbers that are rounded to 2^-24.
TEST(ReferenceOcclusion, masksAreUndecidedWithinAFewRoundingsOfTheirCutoff) {
    for (const float side : {1.0f, -1.0f}) {
        EXPECT_TRUE(shadowOf({.edge = 0.5, .opacity = 0.5f + side * 6e-8f}).isUndecided);
        EXPECT_FALSE(shadowOf({.edge = 0.5, .opacity = 0.5f + side * 1e-5f}).isUndecided);
        EXPECT_EQ(shadowOf({.edge = 0.5, .opacity = 0.5f + side * 1e-5f}).share, side > 0.0f ? 0.0 : 1.0);
    }
}

/// Octahedral coordinates of 12 bits rotate a triangle's normal by up to 1e-3, so light at a smaller angle to the
/// triangle may be blocked.
TEST(ReferenceOcclusion, lightAlongItsOwnTriangleIsUndecidedAsFarAsTheStoredNormalTurns) {
    const auto isUndecided = [](double rise) { return shadowOf({.toLight = {1.0, 0.0, rise}}).isUndecided; };
    for (const double side : {1.0, -1.0}) {
        EXPECT_TRUE(isUndecided(side * 1e-3));
        EXPECT_FALSE(isUndecided(side * 1e-2));
    }
}

/// A sun on the horizon is half hidden. The normal's rotation moves the cut, by much of a small sun and by less than a
/// hundredth of a large one.
TEST(ReferenceOcclusion, whatRoundingTakesOfALightDecidesFromAHundredthOn) {
    const auto ofSun = [](double radians) { return shadowOf({.toLight = {1.0, 0.0, 0.0}, .sunRadians = radians}); };
    EXPECT_TRUE(ofSun(0.02).isUndecided);
    EXPECT_FALSE(ofSun(0.7).isUndecided);
    EXPECT_NEAR(ofSun(0.02).share, 0.5, 0.02);
}

/// An image's first row is at the top of a quad, its first column at the left (tests/support/TestScenes.h). The pattern
/// of opaque texels has no rotational and no mirror symmetry.
TEST(ReferenceOcclusion, aMaskHidesLightWhereItsTextureStandsUpright) {
    constexpr int kSide = 4;
    constexpr const char* kOpaque[kSide] = {"##..", //
                                            "#...", //
                                            "#..#", //
                                            "...."};
    scenes::Scene scene = test::quadScene({});
    scene.materials[0].alphaMode = scenes::AlphaMode::Mask;
    scene.materials[0].doubleSided = true;
    scenes::Image& image = scene.images.emplace_back();
    image.name = "mask";
    image.width = image.height = kSide;
    for (const char* row : kOpaque)
        for (int x = 0; x < kSide; ++x)
            for (const int value : {255, 255, 255, row[x] == '#' ? 255 : 0}) image.texels.push_back(std::byte(value));
    scenes::TextureUse& use = scene.materials[0].texture(scenes::TextureSlot::BaseColor);
    use.image = 0;
    use.sampler.magnification = use.sampler.minification = scenes::Filter::Nearest;
    // From the front, the back, and mirrored.
    for (const double mirror : {1.0, -1.0}) {
        scene.nodes[0].parentFromNode[0].x = mirror;
        const Objects objects(scene, CameraRays(scene.cameras[0], {1, 1}));
        const Casters casters(scene, objects);
        const glm::dvec3 quadRWS = -glm::dvec3(scene.cameras[0].worldFromCamera[3]);
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                for (const double side : {1.0, -1.0}) {
                    const glm::dvec3 place(mirror * ((x + 0.4) * 2.0 / kSide - 1.0), 1.0 - (y + 0.7) * 2.0 / kSide,
                                           0.0);
                    const Segment across{quadRWS + place + glm::dvec3(0.0, 0.0, side) - casters.centreRWS(),
                                         glm::dvec3(0.0, 0.0, -2.0 * side)};
                    const Casters::Met met = casters.meet(across, nullptr);
                    EXPECT_EQ(met.isHidden, kOpaque[y][x] == '#') << x << ", " << y << ", " << side << ", " << mirror;
                    EXPECT_FALSE(met.isUndecided);
                }
    }
}

} // namespace
} // namespace tessera::reference
