// link_programs SCENE [KEY=VALUE...]: links the programs of a frame, whose instructions count.py has Mesa list. Draws
// nothing, so the rasteriser compiles none. Keys: options of scene files, and `lights`.
#include <exception>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "engine/Renderer.h"
#include "engine/Settings.h"
#include "renderer/gpu/Context.h"
#include "renderer/shader/ProgramLibrary.h"
#include "scenes/Load.h"

int main(int argc, char** argv) try {
    using namespace tessera;
    if (argc < 2) {
        fmt::print(stderr, "usage: link_programs SCENE [KEY=VALUE...]\n");
        return 2;
    }
    scenes::LoadOptions options;
    options.useAssets = false; // not every user has the asset scenes
    engine::ViewRequest request;
    request.settings.sizePixels = {1280, 720};
    for (int i = 2; i < argc; ++i) {
        const std::string_view word(argv[i]);
        const std::string key(word.substr(0, word.find('='))), value(word.substr(word.find('=') + 1));
        if (key == "lights")
            options.lights = std::stoi(value);
        else
            engine::settingOf(key).read(request, value);
    }
    const std::unique_ptr<gpu::Context> context = gpu::Context::create();
    const gpu::Capabilities& driver = context->capabilities();
    fmt::print("{}, OpenGL {}\n", driver.renderer.substr(0, driver.renderer.find(' ')), driver.version);
    shader::ProgramLibrary programs;
    programs.warm(engine::framePrograms(scenes::loadScene(argv[1], options), request.technique, request.settings));
    return 0;
} catch (const std::exception& error) {
    fmt::print(stderr, "link_programs: {}\n", error.what());
    return 1;
}
