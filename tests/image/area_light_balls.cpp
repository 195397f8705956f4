// Area lights on a ball against the integral over a light: docs/area-lights.md.
#include <array>

#include "tests/image/AreaLightTest.h"

namespace tessera {
namespace {

using scenes::LightType;
using namespace test;

class AreaLightBalls : public EnvironmentTest {
protected:
    /// Error of an image of a ball against the integral over the light.
    BallError onBall(const scenes::Material& material, LightType type) {
        scenes::Scene scene = ballUnderSky(material);
        scene.lights = {areaLight(type, {1.2, 1.5, 2.0}, {-1.2, -1.5, -2.0}, 1.0f)};
        scene.lights[0].isSeen = false; // a corner of the rectangle would be visible in the image
        return errorOfBall(scene, 48, 0);
    }
};

/// Every type at each roughness, or at one in a short sweep: types differ only in their outlines.
TEST_SWEEP(AreaLightBalls, onABallIsNearTheIntegralOverTheLight) {
    using enum LightType;
    std::vector<std::pair<LightType, double>> balls{
        {Rectangle, 1.0}, {Disk, 0.25}, {Sphere, 0.0}, {Tube, 0.75}, {Polygon, 0.5}};
    if (isWholeSweep()) {
        balls.clear();
        for (const LightType type : kAreaTypes)
            for (const double roughness : {0.0, 0.25, 0.5, 0.75, 1.0}) balls.emplace_back(type, roughness);
    }
    for (const auto& [type, roughness] : balls) {
        const BallError error = onBall(metalOf(roughness), type);
        fmt::print("{:9} roughness {:.2f} bias {:+.1e} relMSE {:.1e}\n", scenes::infoOf(type).name, roughness,
                   error.bias, error.relMse);
        // Limits for lobe shapes: twice the worst error. A mirror shows only the outline, where pixels may differ.
        EXPECT_LE(std::abs(error.bias), roughness > 0.0 ? 0.03 : 2e-3);
        EXPECT_LE(error.relMse, roughness > 0.0 ? 0.025 : 1e-4);
    }
}

/// A metal floor viewed at a grazing angle, by parallel rays at this cosine to its normal. The light stands behind the
/// visible part, 1 m above it, and leans towards it.
class AreaLightFloors : public EnvironmentTest {
protected:
    static scenes::Scene floorUnder(LightType type, double roughness, double cosView) {
        scenes::Scene scene = quadScene(twoSidedMetal(1.0, roughness));
        scene.nodes[0].parentFromNode = glm::dmat4(10.0);
        scene.nodes[0].parentFromNode[3][3] = 1.0;
        scenes::Camera& camera = scene.cameras[0];
        makeOrthographic(camera, 2.0 * cosView); // 4 m of the floor
        camera.worldFromCamera = scenes::worldFromLookAt(9.0 * atCosine(cosView), glm::dvec3(0.0));
        scene.lights = {areaLight(type, {-2.5, 0.0, 1.0}, {1.0, 0.0, -0.5}, 1.0f)};
        scene.lights[0].isSeen = false;
        return scene;
    }
    std::vector<float> shown(const scenes::Scene& scene, const frame::AreaSettings& area) {
        frame::FrameSettings settings = ofSize(40, 20);
        settings.area = area;
        return drawn(scene, settings);
    }
    static validation::ReferencePicture integral(const scenes::Scene& scene) {
        return strictReference(scene, ofSize(40, 20));
    }
};

struct FloorFigures {
    double bias, relMse; ///< of linearly transformed cosines
    double sampledRelMse;
};
constexpr std::array kFloorLights{LightType::Rectangle, LightType::Sphere, LightType::Tube};
/// The table of docs/area-lights.md.
constexpr struct {
    double cosView, roughness;
    FloorFigures byLight[kFloorLights.size()];
} kFloors[] = {
    {0.1, 0.1, {{-0.022, 7e-4, 5e-2}, {-0.032, 1e-3, 2e-2}, {-0.021, 3e-3, 4e-2}}},
    {0.1, 0.25, {{-0.068, 2e-2, 9e-3}, {-0.046, 9e-2, 5e-3}, {-0.022, 3e-1, 8e-3}}},
    {0.1, 0.5, {{-0.094, 6e-2, 3e-3}, {-0.15, 1e-1, 1e-3}, {-0.12, 2e-1, 3e-3}}},
    {0.1, 0.75, {{-0.13, 7e-2, 2e-3}, {-0.12, 4e-2, 6e-4}, {-0.085, 5e-2, 2e-3}}},
    {0.1, 1.0, {{0.025, 3e-3, 9e-4}, {0.008, 2e-3, 3e-4}, {0.003, 2e-3, 1e-3}}},
    {0.3, 0.1, {{0, 2e-4, 4e-2}, {0, 2e-4, 8e-3}, {0.001, 3e-4, 1e-2}}},
    {0.3, 0.25, {{-0.001, 3e-3, 1e-2}, {0.003, 1e-2, 4e-3}, {0.008, 3e-2, 5e-3}}},
    {0.3, 0.5, {{-0.05, 2e-2, 4e-3}, {-0.032, 3e-2, 1e-3}, {-0.023, 6e-2, 3e-3}}},
    {0.3, 0.75, {{-0.086, 3e-2, 1e-3}, {-0.05, 1e-2, 4e-4}, {-0.026, 2e-2, 2e-3}}},
    {0.3, 1.0, {{0.013, 7e-4, 8e-4}, {0.014, 5e-4, 3e-4}, {0.013, 6e-4, 1e-3}}},
};

TEST_SWEEP(AreaLightFloors, thatAreSeenFlatAreAsNearTheIntegralAsTheDocumentSays) {
    for (const auto& [cosView, roughness, byLight] : everyNth(std::vector(std::begin(kFloors), std::end(kFloors)), 10))
        for (std::size_t i = 0; i < kFloorLights.size(); ++i) {
            const LightType type = kFloorLights[i];
            const FloorFigures& stated = byLight[i];
            const scenes::Scene scene = floorUnder(type, roughness, cosView);
            const validation::ReferencePicture truth = integral(scene);
            const BallError closed = errorOf(shown(scene, {}), truth);
            const BallError sampled = errorOf(shown(scene, {frame::AreaLights::Sampled, 16}), truth);
            fmt::print("{:9} cosine {:.1f} roughness {:.2f} bias {:+.1e} relMSE {:.1e}; sampled {:+.1e} {:.1e}\n",
                       scenes::infoOf(type).name, cosView, roughness, closed.bias, closed.relMse, sampled.bias,
                       sampled.relMse);
            EXPECT_NEAR(closed.bias, stated.bias, 1e-3 + 0.1 * std::abs(stated.bias));
            EXPECT_LE(closed.relMse, 1.5 * stated.relMse);
            EXPECT_LE(std::abs(sampled.bias), 0.013) << "the noise of 800 pixels";
            EXPECT_LE(sampled.relMse, 1.5 * stated.sampledRelMse);
        }
}

/// Measures the error of linearly transformed cosines without the reference, by the engine's sampled area lights.
TEST_F(AreaLightFloors, samplesMeasureTheErrorOfTransformedCosines) {
    const scenes::Scene scene = floorUnder(LightType::Sphere, 0.5, 0.1);
    const std::vector<float> closed = shown(scene, {});
    validation::ReferencePicture truth = integral(scene);
    const BallError byIntegral = errorOf(closed, truth);
    truth.picture.rgba = shown(scene, {frame::AreaLights::Sampled, 256});
    const BallError bySamples = errorOf(closed, truth);
    EXPECT_NEAR(bySamples.bias, byIntegral.bias, 2e-3);
    EXPECT_NEAR(bySamples.relMse / byIntegral.relMse, 1.0, 0.05);
}

/// A coat above black, so that nothing else reflects; the same lobe of a dielectric and of a metal; a coloured
/// dielectric; and a sheen, which is as broad as a diffuse reflection here.
TEST_F(AreaLightBalls, onABallOfLayersIsNearTheIntegralOverTheLight) {
    scenes::Material coat = coatedSheet();
    coat.baseColor = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    coat.specularFactor = 0.0f;
    scenes::Material lobe = blackDielectric(0.3);
    lobe.name = "lobe of a dielectric";
    scenes::Material metal = lobe, dielectric = lobe;
    metal.name = "metal";
    metal.metallic = 1.0f;
    dielectric.name = "dielectric";
    metal.baseColor = dielectric.baseColor = glm::vec4(1.0f);
    struct Case {
        scenes::Material material;
        double bias, relMse; ///< limits
    };
    // The bias of a dielectric and a coat is that of the Fresnel factor, which is averaged over the lobe and grows
    // towards the rim: measured 0.10 for both, and 0.011 for a metal, whose lobe has the same shape and no such factor.
    // A sheen of roughness 0.5 as broad as a diffuse reflection has a bias of -0.06 and a relMSE of 0.014 under a point
    // light: measured -0.09 and 1e-2. Leaving out a layer is off by a third and more.
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
        scenes::Material brushed = metalOf(0.4);
        brushed.anisotropyStrength = 0.8f; // alphas of 0.70 and 0.16
        brushed.anisotropyRotationRadians = float(turnRadians);
        const BallError error = onBall(brushed, LightType::Rectangle);
        fmt::print("turned by {:.2f}: bias {:+.1e} relMSE {:.1e}\n", turnRadians, error.bias, error.relMse);
        // An isotropic lobe of the same strength is off by 0.5 to 0.7.
        EXPECT_LE(std::abs(error.bias), 0.4);
        EXPECT_LE(error.relMse, 0.25);
    }
}

} // namespace
} // namespace tessera
