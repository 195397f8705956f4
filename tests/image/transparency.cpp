// Transparent surfaces and the order in which they are drawn.
#include "tests/image/EnvironmentTest.h"
#include "tests/image/ImageTest.h"

namespace tessera {
namespace {

using engine::Technique;
using namespace test;

class Transparency : public EnvironmentTest {};

/// Triangles that face away are drawn before those that face the camera, in the reference too. A convex shell has one
/// of each in every pixel, so that the order of triangles in the file does not matter.
TEST_F(Transparency, aConvexShellLooksTheSameInAnyOrderOfItsTriangles) {
    scenes::Material tinted = materialOf(scenes::MaterialModel::MetallicRoughness, {0.9f, 0.4f, 0.2f, 0.5f});
    tinted.doubleSided = true;
    scenes::Material sheet = tinted;
    tinted.alphaMode = scenes::AlphaMode::Blend;
    scenes::Material oneSided = tinted;
    oneSided.doubleSided = false;
    sheet.transmission = 0.8f;
    sheet.perceptualRoughness = 0.0f;
    for (const scenes::Material& material : {tinted, oneSided, sheet}) {
        scenes::Scene scene = ballUnderSky(material);
        scenes::Light& sun = scene.lights.emplace_back();
        sun.type = scenes::LightType::Directional;
        sun.directionWS = glm::normalize(glm::dvec3(-0.3, -0.5, -1.0));
        frame::FrameSettings settings = ofSize(32, 32);
        std::vector<std::uint32_t>& indices = scene.meshes[0].indices;
        const auto reversed = [&] { // triangles, not their corners
            for (std::size_t i = 0, j = indices.size() - 3; i < j; i += 3, j -= 3)
                std::swap_ranges(indices.begin() + std::ptrdiff_t(i), indices.begin() + std::ptrdiff_t(i + 3),
                                 indices.begin() + std::ptrdiff_t(j));
        };
        std::vector<float> before;
        for (const bool isReversed : {false, true}) {
            if (isReversed) reversed();
            const std::vector<float> seen = drawn(scene, settings, Technique::Forward);
            if (isReversed) {
                EXPECT_EQ(seen, before);
            }
            before = seen;
            const validation::ReferencePicture truth = strictReference(scene, settings);
            for (std::size_t i = 0; i < seen.size(); ++i) {
                if (i % 4 == 3) continue; // coverage
                ASSERT_NEAR(seen[i], truth.picture.rgba[i], 2e-4) << i << ", reversed " << isReversed;
            }
        }
    }
}

/// The view ids for outlines: ids of the nearest surface, transparent or not.
class NearestIds : public ImageTest {};

TEST_F(NearestIds, areThoseOfASceneWithoutTransparentSurfaces) {
    const scenes::Scene opaque = scenes::loadScene("spheres");
    scenes::Scene scene = opaque;
    for (std::size_t i = 1; i < scene.materials.size(); i += 2) scene.materials[i].alphaMode = scenes::AlphaMode::Blend;
    frame::FrameSettings settings = withView(ofSize(160, 90), frame::DebugView::Ids);
    engine::Renderer renderer(context(), scene), truth(context(), opaque);
    const std::vector<float> wanted = truth.render(engine::Technique::Forward, settings).radiance;
    EXPECT_FALSE(renderer.render(engine::Technique::Forward, settings).radiance == wanted) << "nothing is transparent";
    settings.idsOfNearest = true;
    EXPECT_TRUE(renderer.render(engine::Technique::Forward, settings).radiance == wanted);
    EXPECT_TRUE(truth.render(engine::Technique::Forward, settings).radiance == wanted);
}

} // namespace
} // namespace tessera
