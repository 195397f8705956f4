// Rough glass that transmits hardly anything, beside other surfaces: its wider tolerance does not apply to them.

#include "tests/image/ImageTest.h"
#include "tests/support/ShaderMutant.h"
#include "validation/compare/TechniqueCompare.h"

namespace tessera {
namespace {

using namespace test;

class ReferenceGlass : public ImageTest {
protected:
    /// A floor under a sun, and above it a rough ball that covers a hundredth of the image.
    static scenes::Scene floorWithBall(float ior) {
        scenes::Material paint;
        paint.metallic = 0.3f;
        paint.perceptualRoughness = 0.5f;
        paint.baseColor = {0.6f, 0.5f, 0.4f, 1.0f};
        scenes::Scene scene = quadScene(paint);
        scenes::Material glass;
        glass.metallic = 0.0f;
        glass.perceptualRoughness = 0.3f;
        glass.transmission = 1.0f;
        glass.thicknessMetres = 0.05f;
        glass.ior = ior;
        scene.materials.push_back(glass);
        scenes::builtin::appendSphere(scene.meshes.emplace_back(), {0.0, 0.0, 0.3}, 0.08, 64, 32);
        scene.nodes.emplace_back().instances = {{1, 1}};
        scenes::Light sun = sunLight(glm::dvec3(-0.3, -0.1, -1.0));
        sun.intensity = 3.0f;
        scene.lights = {sun};
        scene.cameras[0].worldFromCamera = scenes::worldFromLookAt({0.0, -0.3, 3.0}, {0.0, 0.0, 0.0});
        return scene;
    }
    validation::ComparePair compared(engine::Renderer& renderer) {
        validation::CompareRequest request;
        request.techniques = {engine::Technique::Deferred};
        request.against = validation::Reference{};
        request.settings.sizePixels = {64, 36};
        request.settings.refraction = frame::Refraction::Environment;
        return validation::compareTechniques(renderer, context().capabilities(), request).record.pairs.front();
    }
};

TEST_F(ReferenceGlass, aFaultOfTheLightBesideGlassThatTransmitsNothingIsFound) {
    const ShaderMutant shaders;
    const std::string light = "layeredBrdfCosine(seen, incident.toLightLS) * incident.irradiance";
    shaders.replace("lib/lighting/lighting.glsl", light, "1.02 * " + light);
    for (const float ior : {1.5f, 1000.0f, 0.0f}) {
        SCOPED_TRACE(ior);
        const scenes::Scene scene = floorWithBall(ior);
        engine::Renderer renderer(context(), scene), brighter(context(), scene, shaders.tree());
        const validation::ComparePair right = compared(renderer), wrong = compared(brighter);
        fmt::print("index {}: relMse {:.1e}, with a fault {:.1e}\n", ior, right.figures.relMse, wrong.figures.relMse);
        EXPECT_TRUE(right.verdict.ok) << testing::PrintToString(right.verdict.missed);
        EXPECT_FALSE(wrong.verdict.ok);
        EXPECT_EQ(right.tolerance.relMse, 1e-6);
        EXPECT_EQ(right.tolerance.p999Rel, 6e-3);
        EXPECT_EQ(right.tolerance.bias, 5e-4);
    }
}

/// Reflection of such glass has the tolerance of any surface.
TEST_F(ReferenceGlass, aFaultOfItsHighlightsIsFound) {
    const ShaderMutant shaders;
    const std::string light = "layeredBrdfCosine(seen, incident.toLightLS) * incident.irradiance;";
    shaders.replace(
        "lib/lighting/lighting.glsl", light,
        light + "\n#if HAS_PASSING_LIGHT\nreflected *= seen.surface.transmission > 0.5 ? 1.05 : 1.0;\n#endif\n");
    for (const float ior : {6.0f, 1000.0f, 0.0f}) {
        SCOPED_TRACE(ior);
        scenes::Scene scene = floorWithBall(ior);
        scene.materials[1].perceptualRoughness = 0.6f; // a broad highlight
        engine::Renderer renderer(context(), scene), brighter(context(), scene, shaders.tree());
        const validation::ComparePair right = compared(renderer), wrong = compared(brighter);
        fmt::print("index {}: relMse {:.1e}, with a fault {:.1e}\n", ior, right.figures.relMse, wrong.figures.relMse);
        EXPECT_TRUE(right.verdict.ok) << testing::PrintToString(right.verdict.missed);
        EXPECT_FALSE(wrong.verdict.ok);
    }
}

/// A strong tint reflects nearly all red and transmits nearly all green and blue.
TEST_F(ReferenceGlass, channelsThatPassAreHeldToWhatTheyPass) {
    scenes::Scene scene = floorWithBall(1.5f);
    scene.materials[1].specularColor = {24.0f, 1.0f, 1.0f};
    frame::FrameSettings settings = ofSize(64, 36);
    settings.refraction = frame::Refraction::Environment;
    const auto weights = strictReference(scene, settings).errorWeights;
    EXPECT_LT(std::ranges::min(weights, {}, &glm::vec3::r).r, 0.7f);
    for (const glm::vec3& weight : weights) EXPECT_EQ(glm::vec2(weight.g, weight.b), glm::vec2(1.0f));
}

} // namespace
} // namespace tessera
