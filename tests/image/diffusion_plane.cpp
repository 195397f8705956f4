// Diffusion over a plane against closed forms.

#include "tests/image/DiffusionTest.h"

namespace tessera {
namespace {

using namespace test;
namespace builtin = scenes::builtin;

/// Error limits by the side of the atlas. The same passes in double precision err less, and a width off by a tenth errs
/// more than the limits: a step at 256 texels 5.7e-3 against 6.8e-3 or more, at 512 1.5e-3 against 5.4e-3 or more; a
/// dot at 512 0.0187 against 0.0217 or more. Without diffusion a step errs by 0.089. At 256 texels the dot has so few
/// texels that it only checks diffusion along both directions: 0.108, and 0.135 and 0.160 with half or twice the width
/// along v.
struct PlaneBars {
    int side;
    double step, dot, dotEnergy;
};
constexpr PlaneBars kPlaneBars[] = {
    {256, 6.5e-3, 0.115, 0.055}, {512, 2.5e-3, 0.0205, 0.02}, {1024, 8e-4, 0.0135, 0.03}, {2048, 3e-4, 0.005, 0.01}};

/// Checks errors at several sides of the atlas; each step error must be at most 0.7 of the one before.
void expectConvergence(std::span<const PlaneBars> allBars, const std::function<TruthError(int)>& step,
                       const std::function<TruthError(int)>& dot) {
    double before = 0.0;
    for (const PlaneBars& bars : allBars) {
        const int side = bars.side;
        const TruthError ofStep = step(side), ofDot = dot(side);
        fmt::print("{} texels: step {:.2e}, dot {:.2e} with {:.5f} of its light\n", side, ofStep.l2, ofDot.l2,
                   ofDot.energy);
        EXPECT_LE(ofStep.l2, bars.step) << side;
        EXPECT_LE(ofStep.l2, before > 0.0 ? 0.7 * before : 1.0) << side;
        // Texels limit the roundness of the dot.
        EXPECT_LE(ofDot.l2, bars.dot) << side;
        EXPECT_NEAR(ofDot.energy, 1.0, bars.dotEnergy) << side;
        before = ofStep.l2;
    }
}

TEST_F(DiffusionTruth, aStepAndADotDiffuseAsTheClosedFormsSay) {
    expectConvergence(
        std::span(kPlaneBars).first(2), [&](int side) { return stepError(side); },
        [&](int side) { return dotError(side); });
}

TEST_F(DiffusionTruthSlow, aStepAndADotDiffuseAsTheClosedFormsSay) {
    expectConvergence(
        std::span(kPlaneBars).subspan(1), [&](int side) { return stepError(side); },
        [&](int side) { return dotError(side); });
    const double c = 0.6 * std::cos(0.3), s = 0.6 * std::sin(0.3);
    const double turned = stepError(2048, [&](scenes::Scene& scene) { mapTexture(scene, {{c, s}, {-s, c}}); }).l2;
    fmt::print("2048 texels, turned: {:.2e}\n", turned);
    EXPECT_LE(turned, 1e-3); // measured 4.8e-4; at 512 texels a width wrong by a tenth adds 0.004
}

/// Errors of the mean image over edge positions within a texel: on the mean, interpolation between texels only adds the
/// blur of a tent. Along u, along v.
TEST_F(DiffusionTruth, anEdgeAnywhereBetweenTexelsDiffusesByTheClosedFormOnTheMean) {
    constexpr int kTexels = 256, kPlaces = 4;
    constexpr double kShare = 0.9; // scale of the coordinates, so that they can be moved
    scenes::Scene scene = stepScene();
    engine::Renderer renderer(context(), scene);
    for (const bool alongV : {false, true}) {
        Picture mean;
        for (int i = 0; i < kPlaces; ++i) {
            mapTexture(scene,
                       alongV ? glm::dmat2{{0.0, kShare}, {kShare, 0.0}} : glm::dmat2{{kShare, 0.0}, {0.0, kShare}});
            const double texels = (i + 0.5) / kPlaces - 0.5;
            // A sixteenth of the texels on either side is border.
            const auto moved = float(texels / (kTexels * (1.0 - 2.0 / 16.0)));
            for (glm::vec2& texCoord : scene.meshes[0].texCoords[0]) texCoord[alongV ? 1 : 0] += moved;
            renderer.geometryChanged();
            const Picture own = pictureOf(renderer, stepSettings(kTexels));
            if (i == 0) mean = own;
            for (std::size_t k = 0; k < own.rgba.size(); ++k)
                mean.rgba[k] = (i == 0 ? 0.0f : mean.rgba[k]) + own.rgba[k] / float(kPlaces);
        }
        const double error = errorOf(mean, scene.cameras[0], stepAt).l2;
        fmt::print("edges anywhere, along {}: {:.2e}\n", alongV ? "v" : "u", error);
        // In double precision 9.2e-4; with texels measured without the border 1.8e-3, with widths wrong by 5 % 2.7e-3.
        EXPECT_LE(error, 1.3e-3) << (alongV ? "v" : "u");
    }
}

// A wide Gaussian after a narrow one, similar widths, and widths between which tap spacing grows.
TEST_F(DiffusionTruth, anyTwoWidthsDiffuseAStepAsTheClosedFormSays) {
    for (const auto& [narrow, wide] : {std::pair(0.71, 17.9), {0.3, 30.0}, {1.5, 4.5}, {2.6, 5.0}, {5.0, 9.0}}) {
        const double error = stepErrorOf(narrow, wide);
        fmt::print("{} and {} texels: {:.2e}\n", narrow, wide, error);
        // In double precision 1.1e-3 at worst.
        EXPECT_LE(error, 1.6e-3) << narrow << " and " << wide;
    }
}

TEST_F(DiffusionTruth, fewerGaussiansAndHalfTheResolutionAreNearTheClosedForms) {
    const scenes::Scene scene = stepScene();
    engine::Renderer renderer(context(), scene);
    const auto error = [&](int gaussians, bool half, int side = 256) {
        frame::FrameSettings settings = ofSize(896, 8);
        settings.diffusion = {side, gaussians, half};
        return errorOf(pictureOf(renderer, settings), scene.cameras[0], stepAt).l2;
    };
    const double all = error(8, false), halved = error(8, true), smaller = error(8, false, 128);
    double before = all;
    // In double precision 6.36e-3, 0.0406 and 0.0844; with widths a tenth too large 9.2e-3, 0.0438 and 0.0907. One
    // Gaussian is hardly better than none, 0.0888.
    for (const auto& [gaussians, most] : {std::pair(4, 7.2e-3), {2, 0.0425}, {1, 0.087}}) {
        const double own = error(gaussians, false);
        fmt::print("{} Gaussians: {:.2e}\n", gaussians, own);
        EXPECT_GT(own, before);
        EXPECT_LT(own, most);
        before = own;
    }
    fmt::print("all: {:.2e}, at half the resolution {:.2e}, {:.2e} of as many texels\n", all, halved, smaller);
    // Each diffused texel is the mean of four lit ones, which widens it by a sixteenth of its area.
    EXPECT_LT(halved, 1.3 * smaller);
    EXPECT_LT(smaller, 0.017); // in double precision 0.0155
    EXPECT_LT(halved, 0.0205); // the same, 0.0186
}

TEST_F(DiffusionTruth, stretchedAndSlantedTexturesChangeNothing) {
    const double plain = stepError(256).l2;
    for (const double stretch : {10.0, 100.0}) {
        // Shrinks the square so that both directions keep the same number of texels.
        const double own = stepError(256, [&](scenes::Scene& scene) {
                               for (glm::vec3& position : scene.meshes[0].positionsOS) position.z /= float(stretch);
                               mapTexture(scene, {{1.0, 0.0}, {0.0, stretch}});
                           }).l2;
        fmt::print("stretched {}:1: {:.2e}, else {:.2e}\n", stretch, own, plain);
        EXPECT_LE(own, 2.0 * plain + 1e-5) << stretch;
    }
    for (const double stretch : {2.0, 8.0}) {
        // Fewer texels along x.
        const double own = stepError(256, [&](scenes::Scene& scene) {
                               mapTexture(scene, {{1.0 / stretch, 0.0}, {0.0, 1.0}});
                           }).l2;
        const double coarse = stepError(int(256.0 / stretch)).l2;
        fmt::print("{} times fewer texels along x: {:.2e}, with as many both ways {:.2e}\n", stretch, own, coarse);
        EXPECT_LE(own, 1.5 * coarse + 1e-5) << stretch;
    }
}

/// Edges of the light across v and at various angles to the texture. Uses means along the edge, which is only as
/// straight as texels make it.
TEST_F(DiffusionTruth, lightDiffusesAlikeAlongBothDirectionsOfATurnedOrSlantedTexture) {
    scenes::Scene scene = scenes::loadScene("diffusion_truth");
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings;
    settings.diffusion.sideTexels = 512;
    struct Mapping {
        const char* name;
        glm::dmat2 fromXZ;
        double most;
    };
    const auto turned = [](double angle) {
        const double c = 0.6 * std::cos(angle), s = 0.6 * std::sin(angle);
        return glm::dmat2{{c, s}, {-s, c}};
    };
    // In double precision 1.55e-3 along v, where the edge lies between two texels, else 6e-4 to 1.2e-3. A width along u
    // or v that is wrong by a tenth gives 0.0054 or 0.0068 along v, and at an angle to both 0.0023 to 0.0057.
    const Mapping mappings[] = {
        {"along v", {{0.0, 1.0}, {1.0, 0.0}}, 2.5e-3}, {"turned by 0.3", turned(0.3), 1.5e-3},
        {"turned by 0.7", turned(0.7), 1.5e-3},        {"turned by 1.27", turned(1.27), 1.5e-3},
        {"slanted", {{0.6, 0.0}, {0.3, 0.6}}, 1.5e-3}, {"slanted along v", {{0.2, 0.6}, {0.6, 0.13}}, 1.6e-3}};
    for (const Mapping& mapping : mappings) {
        mapTexture(scene, mapping.fromXZ);
        renderer.geometryChanged();
        const double error = meanStepError(renderer, scene, settings);
        fmt::print("{}: {:.2e}\n", mapping.name, error);
        EXPECT_LE(error, mapping.most) << mapping.name;
    }
}

} // namespace
} // namespace tessera
