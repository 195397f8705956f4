// The thickness that the material of a body states, beside how thick the body is.
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "scenes/builtin/Shapes.h"
#include "tests/image/GlassTest.h"

namespace tessera {
namespace {

using namespace test;

class GlassThickness : public GlassTest {};

/// Back faces tell how far light goes through a body. What it absorbs per metre stays the same down to a stated
/// thickness that absorbs less than a rounding of the light.
TEST_F(GlassThickness, countsForNothingWhereBackFacesTellTheWay) {
    constexpr double kDeepMetres = 0.4;
    scenes::Material tinted = bareGlass(1.5);
    tinted.attenuationDistanceMetres = 1.0f;
    tinted.attenuationColor = {0.25f, 0.5f, 1.0f};
    frame::FrameSettings settings = ofSide(16);
    settings.refraction = frame::Refraction::BackFaces;
    for (const float thicknessMetres : {3.0f, 1e-3f, 1e-6f, 1e-9f}) {
        tinted.thicknessMetres = thicknessMetres;
        scenes::Scene scene = quadScene(tinted);
        scene.meshes[0] = {};
        scenes::builtin::appendBox(scene.meshes[0], {-4.0, -4.0, -kDeepMetres}, {4.0, 4.0, 0.0});
        scene.nodes[0].parentFromNode = glm::dmat4(1.0);
        scene.cameras[0].projection = scenes::Projection::Orthographic;
        scene.cameras[0].halfHeightMetres = 1.0;
        scene.environment = evenEnvironment(1.0);
        const std::vector<float> shown = drawn(scene, settings);
        for (std::size_t pixel = 0; pixel < shown.size(); pixel += 4)
            for (std::size_t c = 0; c < 3; ++c) {
                const double wanted = std::pow(double(tinted.attenuationColor[glm::length_t(c)]), kDeepMetres);
                // As the slab of GlassBehind: the depth of the far side and the filtered map round.
                ASSERT_NEAR(shown[pixel + c], wanted, 1e-4 * wanted) << thicknessMetres << " m, channel " << c;
            }
    }
}

} // namespace
} // namespace tessera
