// The diffusion integral over the surface, compared with closed forms on a plane.
#include "validation/reference/Diffusion.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scenes/Load.h"
#include "scenes/builtin/DiffusionTruth.h"
#include "validation/reference/Render.h"

namespace tessera::reference {
namespace {

namespace builtin = scenes::builtin;

/// Renders a strip of diffusion_truth from above, around a point; rows differ in their random points alone.
Rendered strip(const scenes::Scene& scene, const glm::dvec3& middleWS, glm::ivec2 sizePixels, double widthMetres) {
    Settings settings;
    settings.sizePixels = sizePixels;
    settings.diffusionPoints = 1024;
    settings.findsAlternatives = false;
    settings.camera = scene.cameras[0];
    settings.camera.projection = scenes::Projection::Orthographic;
    settings.camera.worldFromCamera = glm::dmat4({1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, -1.0, 0.0}, {0.0, 1.0, 0.0, 0.0},
                                                 glm::dvec4(middleWS + glm::dvec3(0.0, 1.0, 0.0), 1.0));
    settings.camera.halfHeightMetres = 0.5 * widthMetres * sizePixels.y / sizePixels.x;
    settings.camera.nearMetres = 0.01;
    settings.camera.farMetres = 3.0;
    return render(scene, settings);
}

/// RMS error of a channel's mean over the rows, relative to the RMS of the truth.
template <typename Truth>
double errorOf(const Rendered& rendered, int channel, double widthMetres, Truth truth) {
    double wrong = 0.0, whole = 0.0;
    for (int x = 0; x < rendered.width; ++x) {
        double mean = 0.0;
        for (int y = 0; y < rendered.height; ++y)
            mean += rendered.radiance[std::size_t(y * rendered.width + x)][channel] / rendered.height;
        const double right = truth(widthMetres * ((x + 0.5) / rendered.width - 0.5))[channel];
        wrong += (mean - right) * (mean - right);
        whole += right * right;
    }
    return std::sqrt(wrong / whole);
}

TEST(ReferenceDiffusion, aStepOfLightIsASumOfErrorFunctions) {
    const scenes::Scene scene = scenes::loadScene("diffusion_truth");
    constexpr double kWidth = 0.4;
    // The strip is so low that each column has one distance from the edge.
    const Rendered rendered = strip(scene, {builtin::kTruthEdgeX, 0.0, 0.0}, {80, 16}, kWidth);
    for (int channel = 0; channel < 3; ++channel) {
        const double error =
            errorOf(rendered, channel, kWidth, [](double beyond) { return builtin::diffusedStep(beyond); });
        fmt::print("channel {}: {:.2e}\n", channel, error);
        EXPECT_LE(error, 0.01) << channel;
    }
    double whole = 0.0, apart = 0.0;
    for (const Diffusion::Answer& answer : rendered.diffused) {
        whole += answer.whole.r / double(rendered.diffused.size());
        apart += answer.apart;
    }
    EXPECT_NEAR(whole, 1.0, 2e-3) << "the profile's integral over an unbounded plane";
    EXPECT_EQ(apart, 0.0);
}

TEST(ReferenceDiffusion, aDotOfLightIsTheProfile) {
    const scenes::Scene scene = scenes::loadScene("diffusion_truth");
    constexpr double kWidth = 0.16;
    const Rendered rendered = strip(scene, builtin::kTruthDotWS, {80, 16}, kWidth);
    double wrong = 0.0, whole = 0.0;
    for (int y = 0; y < rendered.height; ++y) {
        for (int x = 0; x < rendered.width; ++x) {
            const double pixel = kWidth / rendered.width;
            const glm::dvec2 place =
                pixel * (glm::dvec2(x, y) + 0.5 - 0.5 * glm::dvec2(rendered.width, rendered.height));
            const glm::dvec3 right = builtin::diffusedDot(glm::length(place));
            const glm::dvec3 own = rendered.radiance[std::size_t(y * rendered.width + x)];
            wrong += glm::dot(own - right, own - right);
            whole += glm::dot(right, right);
        }
    }
    const double error = std::sqrt(wrong / whole);
    fmt::print("dot: {:.2e}\n", error);
    // Noise of the points that hit the dot: measured 0.015.
    EXPECT_LE(error, 0.03);
}

TEST(ReferenceDiffusion, anAreaLightEntersAsOneFromFarAwayDoesOfTheSameIrradiance) {
    scenes::Scene scene = scenes::loadScene("diffusion_truth");
    scene.lights.clear();
    scenes::Light& light = scene.lights.emplace_back();
    light.type = scenes::LightType::Directional;
    light.directionWS = {0.0, -1.0, 0.0};
    const Rendered wanted = strip(scene, builtin::kTruthDotWS, {8, 4}, 0.1);
    // The disk has a half angle of 45 degrees; a small light of its area would give twice as much.
    light.type = scenes::LightType::Disk;
    light.positionWS = glm::dvec3(0.0, 1000.0, 0.0);
    light.radiusMetres = 1000.0f;
    light.intensity = float(2.0 / std::numbers::pi);
    const Rendered found = strip(scene, builtin::kTruthDotWS, {8, 4}, 0.1);
    for (std::size_t i = 0; i < wanted.radiance.size(); ++i) {
        ASSERT_GT(wanted.radiance[i].g, 0.0);
        // The diffusion integral takes irradiance that errs by at most 1e-3.
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(found.radiance[i][c], wanted.radiance[i][c], 1e-3 * wanted.radiance[i][c]) << i;
    }
}

} // namespace
} // namespace tessera::reference
