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
};

} // namespace tessera::test
