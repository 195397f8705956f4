// Lights truncated by a range tolerance.
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/ChooseCulling.h"
#include "engine/PrepareView.h"
#include "tests/image/ImageTest.h"
#include "tests/support/Random.h"
#include "validation/compare/RangeTruncation.h"
#include "validation/compare/TechniqueCompare.h"
#include "validation/culling/LightOracle.h"
#include "validation/figures/ErrorFigures.h"

namespace tessera {
namespace {

using engine::Technique;
using namespace test;

constexpr int kRangeSide = 64;

scenes::Light attenuatedLight(const glm::dvec3& positionWS, float intensity, const glm::vec3& abc) {
    scenes::Light light = pointLight(positionWS, intensity);
    light.falloff = scenes::Falloff::Attenuation;
    light.attenuation = abc;
    return light;
}

/// Replaces the scene's lights by a roomful that attenuate by A B C, every third a spot.
scenes::Scene inAttenuatedLights(scenes::Scene scene) {
    scene.lights.clear();
    Random random(21);
    for (int i = 0; i < 48; ++i) {
        const glm::dvec3 place(random.between(-4.0, 4.0), random.between(-0.5, 2.0), random.between(-2.0, 3.0));
        scene.lights.push_back(
            attenuatedLight(place, float(random.logarithmic(0.05, 2.0)), {random.unit(), random.unit(), 1.0}));
        scene.lights.back().color = {random.unit(), random.unit(), random.unit()};
        if (i % 3 > 0) continue;
        scene.lights.back().type = scenes::LightType::Spot;
        scene.lights.back().directionWS = glm::dvec3(0, -1, 0);
    }
    return scene;
}

class LightRange : public ImageTest {};

TEST_F(LightRange, anEndedLightIsExactlyZeroFromItsRadiusOnAndWindowedBefore) {
    const scenes::Material painted = lambert({0.75f, 0.5f, 0.25f, 1.0f});
    scenes::Scene scene = quadScene(painted);
    makeOrthographic(scene.cameras[0], 1.0);
    scene.cameras[0].farMetres = 5.0; // without a far plane depth is coarser: a step of 1e-4 m
    const double a = 0.5, b = 0.25, c = 1.5, intensity = 2.5;
    const glm::dvec3 placeWS(0.25, -0.125, 0.5);
    scene.lights = {attenuatedLight(placeWS, intensity, {a, b, c})};
    frame::FrameSettings settings = ofSize(kRangeSide, kRangeSide);
    settings.rangeTolerance = 1.0;
    const double left = intensity / settings.rangeTolerance - a;
    const double radius = (-b + std::sqrt(b * b + 4.0 * c * left)) / (2.0 * c);
    engine::Renderer renderer(context(), scene);
    for (const engine::TechniqueInfo& technique : engine::techniqueTable()) {
        SCOPED_TRACE(technique.name);
        const Picture picture = engine::toPicture(renderer.render(technique.technique, settings));
        std::size_t beyond = 0, inside = 0;
        for (std::size_t i = 0; i < picture.pixelCount(); ++i) {
            const int x = int(i) % kRangeSide, y = int(i) / kRangeSide;
            const glm::dvec3 pointWS(2.0 * (x + 0.5) / kRangeSide - 1.0, 1.0 - 2.0 * (y + 0.5) / kRangeSide, 0.0);
            const double d = glm::distance(pointWS, placeWS);
            const double whole = intensity / (a + b * d + c * d * d) * placeWS.z / d;
            const double window = std::max(0.0, 1.0 - std::pow(d / radius, 4.0));
            for (int channel = 0; channel < 3; ++channel) {
                const double value = picture.pixel(i)[channel], albedo = painted.baseColor[channel];
                // As for every light: fp32 roundings relative to the light without its window, which is a difference.
                ASSERT_NEAR(value, albedo * whole * window * window, 3e-6 * albedo * whole) << x << " " << y;
                ASSERT_TRUE(d < radius || value == 0.0) << x << " " << y << " holds " << value;
            }
            ++(d >= radius ? beyond : inside);
        }
        EXPECT_GT(beyond, 500u);
        EXPECT_GT(inside, 500u);
    }
}

TEST_F(LightRange, theBiasIsBelowZeroAndVanishesWithTheTolerance) {
    const scenes::Scene scene = inAttenuatedLights(everythingScene());
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = ofSize(160, 90);
    double lastBias = -1.0, lastRelMse = 1.0;
    for (const double tolerance : {0.3, 0.1, 0.03, 0.01, 0.003, 0.001}) {
        SCOPED_TRACE(tolerance);
        settings.rangeTolerance = tolerance;
        const validation::RangeTruncation dropped = validation::rangeTruncation(renderer, Technique::Forward, settings);
        fmt::print("tolerance {:<6} {}\n", tolerance, validation::droppedText(dropped.figures));
        EXPECT_EQ(dropped.tolerance, tolerance);
        EXPECT_EQ(dropped.technique, "forward");
        EXPECT_LT(dropped.figures.bias, 0.0);
        EXPECT_GT(dropped.figures.bias, lastBias);
        EXPECT_GT(dropped.figures.relMse, 0.0);
        EXPECT_LT(dropped.figures.relMse, lastRelMse);
        lastBias = dropped.figures.bias;
        lastRelMse = dropped.figures.relMse;
    }
    // (d / r)^4 of 10 m and 1e5 m is below the fp32 step at 1: every window is exactly 1.
    settings.rangeTolerance = 1e-12;
    const validation::RangeTruncation nothing = validation::rangeTruncation(renderer, Technique::Forward, settings);
    EXPECT_EQ(nothing.figures.bitEqual, 1.0);
    EXPECT_EQ(nothing.figures.bias, 0.0);
}

/// Every technique with every supported method, alternately without pruning, on a scene of everything. In a short sweep
/// each technique with some method and each method with some technique, pruned, on Lambert materials.
TEST_SWEEP(LightRange, anEndedLightIsExactlyTheSameWithEveryTechniqueAndCullingMethod) {
    const bool isWhole = isWholeSweep();
    const scenes::Scene scene = inAttenuatedLights(isWhole ? everythingScene() : lambertScene());
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = ofSize(161, 89);
    settings.rangeTolerance = 0.1;
    const std::vector<float> forward = renderer.render(Technique::Forward, settings).radiance;
    std::size_t listed = 0, turn = 0;
    for (const culling::MethodInfo& method : culling::methodTable()) {
        SCOPED_TRACE(method.name);
        validation::CompareRequest request;
        request.settings = settings;
        request.settings.culling.method = method.method;
        for (const engine::TechniqueInfo& technique : engine::techniqueTable()) {
            if (!engine::supportsMethod(technique.technique, method.method)) continue;
            // Two techniques share each method with light lists.
            if (!isWhole && engine::hasLightLists(technique.technique) && turn++ % 2 != std::size_t(method.method) % 2)
                continue;
            request.techniques.push_back(technique.technique);
            if (engine::prepareView(scene, technique.technique, request.settings).spec.culling.method !=
                culling::Method::None)
                ++listed;
        }
        // Alternates pruning: the forward image is the same with both, as checked at the end.
        if (isWhole) settings.prune = !settings.prune;
        request.settings.prune = settings.prune;
        const validation::CompareRecord record = compareTechniques(renderer, context().capabilities(), request).record;
        EXPECT_TRUE(record.ok()) << validation::compareTable(record);
    }
    EXPECT_GT(listed, isWhole ? 4u : 3u) << "ended lights are there to be culled";
    if (!isWhole) return;
    settings.prune = false;
    EXPECT_EQ(renderer.render(Technique::Forward, settings).radiance, forward);
}

/// Lists of every technique with every method; in a short sweep with one of them, at a quarter of the pixels.
TEST_SWEEP(LightRange, anEndedLightIsNotMissingFromAListThatNeedsIt) {
    const bool isWhole = isWholeSweep();
    const scenes::Scene scene = inAttenuatedLights(isWhole ? everythingScene() : lambertScene());
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings;
    settings.sizePixels = isWhole ? glm::ivec2(321, 179) : glm::ivec2(161, 89);
    settings.rangeTolerance = 0.1;
    std::size_t turn = 0;
    for (const engine::TechniqueInfo& technique : engine::techniqueTable())
        for (const culling::Method method : technique.methods) {
            if (method == culling::Method::None) continue;
            // Deferred techniques with their first method, others with their second.
            if (!isWhole && (turn++ % 2 == 0) != technique.usesGBuffer()) continue;
            settings.culling.method = method;
            const validation::LightOracleFigures figures =
                validation::judgeLights(renderer, technique.technique, settings);
            SCOPED_TRACE(fmt::format("{} {}", technique.name, infoOf(method).name));
            EXPECT_EQ(figures.falseNegatives, 0u);
            EXPECT_EQ(figures.everywhere, 0u);
            EXPECT_GT(figures.needed, figures.covered);
        }
}

// Cones that are narrow or have a hard edge, against the reference.

struct Cone {
    double innerDegrees, outerDegrees;
};

class LightCones : public ImageTest {
protected:
    /// A spot 2 m in front of a wall, at a right angle, viewed so closely that its light fills three quarters of the
    /// image. `worldFromLight` rotates all of it about the origin.
    static scenes::Scene spotOnWall(const Cone& cone, const glm::dmat4& worldFromLight) {
        constexpr double kDegree = std::numbers::pi / 180.0, kMetres = 2.0;
        scenes::Material material = lambert();
        scenes::Scene scene = quadScene(material);
        scenes::Light spot = pointLight(glm::dvec3(worldFromLight * glm::dvec4(0.0, 0.0, kMetres, 1.0)), 100.0f);
        spot.type = scenes::LightType::Spot;
        spot.directionWS = glm::dmat3(worldFromLight) * spot.directionWS;
        spot.innerConeRadians = float(cone.innerDegrees * kDegree);
        spot.outerConeRadians = float(cone.outerDegrees * kDegree);
        scene.lights = {spot};
        const double radiusMetres = kMetres * std::tan(cone.outerDegrees * kDegree);
        scenes::Camera& camera = scene.cameras[0];
        camera.fovYRadians = 2.0 * std::atan(1.02 * radiusMetres / camera.worldFromCamera[3].z);
        camera.worldFromCamera = worldFromLight * camera.worldFromCamera;
        for (scenes::Node& node : scene.nodes) node.parentFromNode = worldFromLight * node.parentFromNode;
        return scene;
    }

    void expectTheReferences(const Cone& cone, const glm::dmat4& worldFromLight, double p999RelAtMost) {
        SCOPED_TRACE(fmt::format("{} to {} degrees", cone.innerDegrees, cone.outerDegrees));
        const scenes::Scene scene = spotOnWall(cone, worldFromLight);
        frame::FrameSettings settings = exactOfSize(160, 160);
        engine::Renderer renderer(context(), scene);
        const Picture truth = validation::referencePicture(scene, settings).picture;
        for (const engine::TechniqueInfo& technique : engine::techniqueTable()) {
            const validation::ErrorFigures figures =
                validation::errorFigures(engine::toPicture(renderer.render(technique.technique, settings)), truth);
            fmt::print("{} to {} degrees, {}: p99.9 {:.1e}, relMse {:.1e}, largest {:.1e}\n", cone.innerDegrees,
                       cone.outerDegrees, technique.name, figures.p999Rel, figures.relMse, figures.maxRel);
            EXPECT_EQ(figures.compared, 160u * 160u);
            EXPECT_GT(figures.litShare, 0.5);
            EXPECT_LE(figures.p999Rel, p999RelAtMost);
        }
    }
};

constexpr double kEveryPicture = 3e-4; // tolerance of the 99.9th percentile (docs/reference.md)

TEST_F(LightCones, aNarrowOrHardConeIsThatOfTheReference) {
    for (const Cone cone : {Cone{0.0, 0.1}, Cone{0.0, 0.5}, Cone{0.0, 1.0}, Cone{0.0, 5.0}, Cone{9.9, 10.0},
                            Cone{0.05, 0.1}, Cone{0.9, 1.0}, Cone{0.0, 20.0}, Cone{20.0, 20.0}})
        expectTheReferences(cone, glm::dmat4(1.0), kEveryPicture);
}

/// The angle from the axis has the fp32 rounding error of ray and axis, 2e-7 rad, in any direction.
TEST_F(LightCones, anObliqueNarrowConeKeepsTheDigitsThatItsRayHas) {
    const glm::dmat4 oblique = glm::rotate(glm::dmat4(1.0), 2.1, glm::normalize(glm::dvec3(0.36, 0.48, 0.8)));
    for (const double outerDegrees : {0.1, 0.5, 1.0, 5.0, 20.0})
        expectTheReferences({0.0, outerDegrees}, oblique, std::max(kEveryPicture, 7e-4 / outerDegrees));
}

} // namespace
} // namespace tessera
