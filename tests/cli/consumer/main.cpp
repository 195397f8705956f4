#include <cstddef>
#include <cstdio>
#include <exception>
#include <memory>

#include "engine/Renderer.h"
#include "renderer/gpu/Context.h"
#include "scenes/Load.h"

using namespace tessera;

/// Loads a built-in scene with the installed library and renders a small image, like a program outside the project.
int main() try {
    const scenes::Scene scene = scenes::loadScene("lattice", {.lights = 4});
    const std::unique_ptr<gpu::Context> context = gpu::Context::create();
    engine::Renderer renderer(*context, scene);
    frame::FrameSettings settings;
    settings.sizePixels = {64, 36};
    const engine::RenderedFrame frame = renderer.render(engine::Technique::Deferred, settings);
    std::size_t covered = 0;
    for (std::size_t pixel = 0; pixel < frame.radiance.size() / 4; ++pixel)
        covered += frame.radiance[pixel * 4 + 3] > 0;

    std::printf("lattice: %zu triangles, %zu lights; %zu of 64x36 pixels covered\n", scenes::triangleCount(scene),
                scene.lights.size(), covered);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
