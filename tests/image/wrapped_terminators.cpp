// Softened terminators where light wraps around a surface.
#include <fmt/format.h>

#include "scenes/builtin/Shapes.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/TestScenes.h"

namespace tessera {
namespace {

using scenes::SubsurfaceMethod;

class WrappedTerminators : public test::ShadowTest {
protected:
    /// A ball of 16 slices alone.
    static scenes::Scene coarseBallOf(SubsurfaceMethod method) {
        scenes::Scene scene = test::ballUnderSun();
        scene.nodes[0].instances = {{0, 0}};
        scene.meshes[0] = {};
        scenes::builtin::appendSphere(scene.meshes[0], glm::dvec3(0.0, 0.6, 0.0), 0.6, 16, 8);
        scenes::Material& skin = scene.materials[0] = {};
        skin.model = scenes::MaterialModel::Lambert;
        skin.subsurface.method = method;
        skin.subsurface.bodyRadiusMetres = 0.6f;
        return scene;
    }
    static frame::FrameSettings settingsOf(frame::ShadowTerminator terminator) {
        frame::FrameSettings settings;
        settings.sizePixels = {96, 54};
        settings.shadows = test::kAllLightsCast;
        settings.shadowFilter = frame::ShadowFilter::Traced;
        settings.shadowTerminator = terminator;
        return settings;
    }
};

// The edge of a plate throws its shadow on it: wrapped light is asked for from above the surface already.
TEST_F(WrappedTerminators, aSurfaceThatWrapsLightIsNotLiftedOffItsTriangles) {
    scenes::Scene scene = coarseBallOf(SubsurfaceMethod::Wrap);
    scene.nodes[0].instances.push_back({1, 0});
    scene.meshes[1] = {};
    scenes::builtin::appendFloor(scene.meshes[1], {-2.0, 1.5, 0.0}, {4.0, 4.0}, {1, 1});
    scene.lights[0].directionWS = glm::normalize(glm::dvec3(0.5, -1.0, -0.6));
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = settingsOf(frame::ShadowTerminator::Softened);
    settings.sizePixels = {192, 108};
    const test::WrongPixels count = test::wrongPixels(renderer, settings);
    fmt::print("{} pixels wrong, {} undecided, {} changed by shadows of {}\n", count.wrong, count.undecided,
               count.hidden, count.covered);
    EXPECT_EQ(count.wrong, 0u);
    EXPECT_GT(count.hidden, count.covered / 25);
}

} // namespace
} // namespace tessera
