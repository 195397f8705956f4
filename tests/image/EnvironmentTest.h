#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/Rendering.h"
#include "scenes/Load.h"
#include "scenes/LoadLedger.h"
#include "scenes/builtin/Pictures.h"
#include "scenes/builtin/Shapes.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/Sweep.h"
#include "tests/support/TestScenes.h"
#include "validation/compare/ReferencePicture.h"

/// Light from everywhere: what its tests have in common.
namespace tessera::test {

inline scenes::Environment environmentOf(int width, int height, const std::function<glm::dvec3(int, int)>& radiance) {
    return {"test", scenes::builtin::drawRadiance("test", width, height, radiance)};
}

/// The same from everywhere.
inline scenes::Environment evenEnvironment(double radiance) {
    return environmentOf(1, 1, [&](int, int) { return glm::dvec3(radiance); });
}

inline scenes::Environment builtinEnvironment(const std::string& name) {
    scenes::LoadLedger ledger;
    std::vector<std::string> warnings;
    return scenes::loadEnvironment(std::string(scenes::kBuiltinPrefix) + name, ledger, warnings);
}

/// A sphere before an orthographic camera, which it fills.
inline scenes::Scene ballUnderSky(const scenes::Material& material) {
    scenes::Scene scene = quadScene(material);
    scene.meshes[0] = {};
    scenes::builtin::appendSphere(scene.meshes[0], {}, 1.0, 96, 48);
    scene.cameras[0].projection = scenes::Projection::Orthographic;
    scene.cameras[0].halfHeightMetres = 1.02;
    return scene;
}

class EnvironmentTest : public ShadowTest {
protected:
    engine::RenderedFrame rendered(const scenes::Scene& scene, frame::EnvironmentLight light, int side = 64,
                                   int samples = 256) {
        frame::FrameSettings settings;
        settings.sizePixels = {side, side};
        settings.environment.light = light;
        settings.environment.samples = samples;
        engine::Renderer renderer(context(), scene);
        return renderer.render(engine::Technique::Deferred, settings);
    }

    struct BallError {
        double bias, relMse;
    };
    /// Of one channel of a picture of ballUnderSky() against the reference.
    BallError errorOfBall(const scenes::Scene& scene, int side, std::size_t channel) {
        frame::FrameSettings settings;
        settings.sizePixels = {side, side};
        const validation::ReferencePicture truth = validation::referencePicture(
            scene, settings, [] {}, validation::Leeway::None);
        engine::Renderer renderer(context(), scene);
        const std::vector<float> radiance = renderer.render(engine::Technique::Deferred, settings).radiance;
        double shown = 0.0, light = 0.0, squares = 0.0, count = 0.0;
        for (std::size_t i = 0; i < truth.picture.pixelCount(); ++i) {
            if (truth.picture.covered[i] == 0) continue;
            const double own = double(radiance[4 * i + channel]), other = double(truth.picture.rgba[4 * i + channel]);
            shown += own;
            light += other;
            squares += (own - other) * (own - other) / ((other + 0.01) * (other + 0.01));
            count += 1.0;
        }
        return {shown / light - 1.0, squares / count};
    }
};

} // namespace tessera::test
