// Area lights on a ball against the integral over a light: docs/area-lights.md.
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tests/image/AreaLightTest.h"
#include "tests/image/EnvironmentTest.h"
#include "tests/support/AreaLights.h"

namespace tessera {
namespace {

using scenes::LightType;
using namespace test;

class AreaLightBalls : public EnvironmentTest {
protected:
    /// Of the picture of a ball against the integral over a light.
    BallError onBall(const scenes::Material& material, LightType type) {
        scenes::Scene scene = ballUnderSky(material);
        scene.lights = {areaLight(type, {1.2, 1.5, 2.0}, {-1.2, -1.5, -2.0}, 1.0f)};
        scene.lights[0].isSeen = false; // the corner of a rectangle reaches into the picture
        return errorOfBall(scene, 48, 0);
    }
    /// For every type, roughness by roughness, or each with some: types differ in their outlines alone.
    void expectNearTheIntegralOnABall();
};
using AreaLightBallsSlow = AreaLightBalls;

/// Against the integral over the light, by roughness and shape: docs/area-lights.md.
void AreaLightBalls::expectNearTheIntegralOnABall() {
    using enum LightType;
    std::vector<std::pair<LightType, double>> balls{
        {Rectangle, 1.0}, {Disk, 0.25}, {Sphere, 0.0}, {Tube, 0.75}, {Polygon, 0.5}};
    if (isWholeSweep()) {
        balls.clear();
        for (const LightType type : kAreaTypes)
            for (const double roughness : {0.0, 0.25, 0.5, 0.75, 1.0}) balls.emplace_back(type, roughness);
    }
    for (const auto& [type, roughness] : balls) {
        scenes::Material metal;
        metal.metallic = 1.0f;
        metal.perceptualRoughness = float(roughness);
        const BallError error = onBall(metal, type);
        fmt::print("{:9} roughness {:.2f} bias {:+.1e} relMSE {:.1e}\n", scenes::infoOf(type).name, roughness,
                   error.bias, error.relMse);
        // The shapes of lobes: the worst is half as large. A mirror has the outline alone, of which pixels may differ.
        EXPECT_LE(std::abs(error.bias), roughness > 0.0 ? 0.03 : 2e-3);
        EXPECT_LE(error.relMse, roughness > 0.0 ? 0.025 : 1e-4);
    }
}
TEST_F(AreaLightBalls, onABallIsNearTheIntegralOverTheLight) {
    expectNearTheIntegralOnABall();
}
TEST_F(AreaLightBallsSlow, onABallIsNearTheIntegralOverTheLight) {
    expectNearTheIntegralOnABall();
}

/// The coat above black, so that it is all there is; the same lobe of a dielectric and of a metal; a dielectric with
/// its colour; and a sheen, which is as broad as a diffuse reflection here.
TEST_F(AreaLightBalls, onABallOfLayersIsNearTheIntegralOverTheLight) {
    scenes::Material coat = coatedSheet();
    coat.baseColor = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    coat.specularFactor = 0.0f;
    scenes::Material lobe;
    lobe.name = "lobe of a dielectric";
    lobe.metallic = 0.0f;
    lobe.perceptualRoughness = 0.3f;
    lobe.baseColor = {0.0f, 0.0f, 0.0f, 1.0f};
    scenes::Material metal = lobe, dielectric = lobe;
    metal.name = "metal";
    metal.metallic = 1.0f;
    dielectric.name = "dielectric";
    metal.baseColor = dielectric.baseColor = glm::vec4(1.0f);
    struct Case {
        scenes::Material material;
        double bias, relMse; ///< allowed
    };
    // Of a dielectric and a coat the bias is that of Fresnel's factor, which is taken as its mean over the lobe and
    // grows towards the rim: measured 0.10 of both, and 0.011 of a metal, whose lobe has the same shape and no such
    // factor. A sheen of roughness 0.5 that is as broad as a diffuse reflection has a bias of -0.06 and a relMSE of
    // 0.014 under a point light: measured -0.09 and 1e-2. One left out is off by a third and more.
    for (const Case& one : {Case{coat, 0.12, 0.01},
                            {lobe, 0.12, 0.01},
                            {metal, 0.03, 0.025},
                            {dielectric, 0.02, 0.01},
                            {velvet(), 0.11, 0.02}}) {
        const BallError error = onBall(one.material, LightType::Rectangle);
        fmt::print("{}: bias {:+.1e} relMSE {:.1e}\n", one.material.name, error.bias, error.relMse);
        EXPECT_LE(std::abs(error.bias), one.bias) << one.material.name;
        EXPECT_LE(error.relMse, one.relMse) << one.material.name;
    }
}

TEST_F(AreaLightBalls, onABrushedBallIsNearTheIntegralOverTheLight) {
    for (const double turnRadians : {0.0, 0.7, 1.5707963}) {
        scenes::Material brushed;
        brushed.metallic = 1.0f;
        brushed.perceptualRoughness = 0.4f;
        brushed.anisotropyStrength = 0.8f; // alphas of 0.70 and 0.16
        brushed.anisotropyRotationRadians = float(turnRadians);
        const BallError error = onBall(brushed, LightType::Rectangle);
        fmt::print("turned by {:.2f}: bias {:+.1e} relMSE {:.1e}\n", turnRadians, error.bias, error.relMse);
        // A round lobe of the same strength has 0.5 to 0.7.
        EXPECT_LE(std::abs(error.bias), 0.4);
        EXPECT_LE(error.relMse, 0.25);
    }
}

} // namespace
} // namespace tessera
