#include "passes/recipes/PreparedFrame.h"

#include <fmt/format.h>

#include "scenes/Error.h"

namespace tessera::recipes {

PreparedFrame prepareFrame(const scenes::Scene& scene, const frame::FrameSettings& settings) {
    if (settings.sizePixels.x < 1 || settings.sizePixels.y < 1) {
        throw InputError(
            fmt::format("a picture of {}x{} pixels has no pixel", settings.sizePixels.x, settings.sizePixels.y));
    }
    if (settings.camera < 0 || settings.camera >= int(scene.cameras.size())) {
        throw InputError(fmt::format("{}: there is no camera {}; the scene has {}", scene.name, settings.camera,
                                     scene.cameras.size()));
    }
    if (settings.soloLight && (*settings.soloLight < 0 || *settings.soloLight >= int(scene.lights.size()))) {
        throw InputError(fmt::format("{}: there is no light {} to show alone; the scene has {} (0 to {})", scene.name,
                                     *settings.soloLight, scene.lights.size(), int(scene.lights.size()) - 1));
    }
    PreparedFrame prepared;
    const scenes::Camera& camera = scene.cameras[std::size_t(settings.camera)];
    // A debug view shows quantities of surfaces; where there is none it shows 0.
    const glm::vec3 background = settings.view == frame::View::Final ? scene.background : glm::vec3(0.0f);
    prepared.view = frame::makeCameraView(camera, settings.sizePixels, settings.space, background);
    prepared.lights = frame::packLights(scene, prepared.view, settings);
    prepared.view.constants.lights = glm::uvec4(prepared.lights.texels.size(), prepared.lights.shown, 0u, 0u);
    prepared.spec = frame::makeFrameSpec(scene, prepared.lights, settings);
    return prepared;
}

} // namespace tessera::recipes
