// Surfaces that show what is behind them, in the order in which they are drawn.
#include <algorithm>

#include "scenes/builtin/Shapes.h"
#include "tests/image/EnvironmentTest.h"

namespace tessera {
namespace {

using engine::Technique;
using namespace test;

class Transparency : public EnvironmentTest {};

/// Triangles that face away are drawn before those that face the camera, in the reference too: of a convex shell each
/// pixel has one of either, and the order in which a file lists them is no matter.
TEST_F(Transparency, aConvexShellLooksTheSameInAnyOrderOfItsTriangles) {
    scenes::Material tinted;
    tinted.model = scenes::MaterialModel::MetallicRoughness;
    tinted.baseColor = {0.9f, 0.4f, 0.2f, 0.5f};
    tinted.doubleSided = true;
    scenes::Material sheet = tinted;
    tinted.alphaMode = scenes::AlphaMode::Blend;
    sheet.transmission = 0.8f;
    sheet.perceptualRoughness = 0.0f;
    for (const scenes::Material& material : {tinted, sheet}) {
        scenes::Scene scene = ballUnderSky(material);
        scenes::Light& sun = scene.lights.emplace_back();
        sun.type = scenes::LightType::Directional;
        sun.directionWS = glm::normalize(glm::dvec3(-0.3, -0.5, -1.0));
        frame::FrameSettings settings;
        settings.sizePixels = {32, 32};
        std::vector<std::uint32_t>& indices = scene.meshes[0].indices;
        const auto reversed = [&] { // triangles, not their corners
            for (std::size_t i = 0, j = indices.size() - 3; i < j; i += 3, j -= 3)
                std::swap_ranges(indices.begin() + std::ptrdiff_t(i), indices.begin() + std::ptrdiff_t(i + 3),
                                 indices.begin() + std::ptrdiff_t(j));
        };
        std::vector<float> before;
        for (const bool isReversed : {false, true}) {
            if (isReversed) reversed();
            engine::Renderer renderer(context(), scene);
            const std::vector<float> seen = renderer.render(Technique::Forward, settings).radiance;
            if (isReversed) {
                EXPECT_EQ(seen, before);
            }
            before = seen;
            const validation::ReferencePicture truth = validation::referencePicture(
                scene, settings, [] {}, validation::Leeway::None);
            for (std::size_t i = 0; i < seen.size(); ++i) {
                if (i % 4 == 3) continue; // the share that is covered
                ASSERT_NEAR(seen[i], truth.picture.rgba[i], 2e-4) << i << ", reversed " << isReversed;
            }
        }
    }
}

} // namespace
} // namespace tessera
