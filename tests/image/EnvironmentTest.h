#pragma once
#include <functional>
#include <string>
#include <vector>

#include "scenes/LoadLedger.h"
#include "scenes/builtin/Pictures.h"
#include "tests/image/ShadowTest.h"

/// Shared scenes and fixtures of environment light tests.
namespace tessera::test {

inline scenes::Environment environmentOf(int width, int height, const std::function<glm::dvec3(int, int)>& radiance) {
    return {"test", scenes::builtin::drawRadiance("test", width, height, radiance)};
}

/// An environment of uniform radiance.
inline scenes::Environment evenEnvironment(double radiance) {
    return environmentOf(1, 1, [&](int, int) { return glm::dvec3(radiance); });
}

inline scenes::Environment builtinEnvironment(const std::string& name) {
    scenes::LoadLedger ledger;
    std::vector<std::string> warnings;
    return scenes::loadEnvironment(std::string(scenes::kBuiltinPrefix) + name, ledger, warnings);
}

/// A sphere that fills an orthographic camera.
inline scenes::Scene ballUnderSky(const scenes::Material& material) {
    scenes::Scene scene = quadScene(material);
    scene.meshes[0] = {};
    scenes::builtin::appendSphere(scene.meshes[0], {}, 1.0, 96, 48);
    makeOrthographic(scene.cameras[0], 1.02);
    return scene;
}

class EnvironmentTest : public ShadowTest {
protected:
    engine::RenderedFrame rendered(const scenes::Scene& scene, frame::EnvironmentLight light, int side = 64,
                                   int samples = 256) {
        frame::FrameSettings settings = ofSize(side, side);
        settings.environment.light = light;
        settings.environment.samples = samples;
        return frameOf(scene, settings);
    }

    struct BallError {
        double bias, relMse;
    };
    /// Bias and relative MSE of one channel over the pixels that the reference covers.
    static BallError errorOf(const std::vector<float>& radiance, const validation::ReferencePicture& truth,
                             std::size_t channel = 0) {
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
    /// The same for an image of ballUnderSky() against the reference.
    BallError errorOfBall(const scenes::Scene& scene, int side, std::size_t channel) {
        const frame::FrameSettings settings = ofSize(side, side);
        return errorOf(drawn(scene, settings), strictReference(scene, settings), channel);
    }
};

} // namespace tessera::test
