#include <filesystem>

#include <fmt/format.h>

#include "apps/Commands.h"
#include "apps/FramePattern.h"
#include "apps/Progress.h"
#include "passes/recipes/Renderer.h"
#include "scenes/Error.h"
#include "validation/PictureFile.h"
#include "validation/Rendering.h"

namespace tessera::app {

namespace {

struct RenderOptions {
    FrameOptions frame;
    std::string output;
    int frames = 0;
    double framesPerSecond = 30.0;
};

void writePicture(const std::string& path, const recipes::RenderedFrame& frame) {
    if (std::filesystem::path(path).extension() == ".exr") {
        validation::writeExr(path, validation::toPicture(frame));
    } else {
        validation::writePng(path, validation::toDisplayImage(frame));
    }
}

void requirePictureExtension(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension != ".exr" && extension != ".png") {
        throw InputError(
            fmt::format("{}: pictures end in .exr (linear, 32 bit) or .png (as a display shows it)", path));
    }
}

int renderFrames(const RenderOptions& options, Request& request, recipes::Renderer& renderer,
                 const GlobalOptions& global) {
    const FramePattern pattern(options.output);
    Progress progress("rendering", std::size_t(options.frames), global.quiet);
    const double start = request.settings.timeSeconds;
    for (int i = 0; i < options.frames; ++i) {
        request.settings.timeSeconds = start + i / options.framesPerSecond;
        writePicture(pattern.path(i), renderer.render(request.technique, request.settings));
        progress.advance();
    }
    return kGood;
}

int render(const RenderOptions& options, const GlobalOptions& global) {
    requirePictureExtension(options.output);
    if (options.frames < 0) throw InputError(fmt::format("--frames {} is less than one frame", options.frames));
    if (!(options.framesPerSecond > 0.0))
        throw InputError(fmt::format("--fps {} must be more than 0", options.framesPerSecond));
    if (options.frames > 0) FramePattern check(options.output);
    Request request = resolve(options.frame);
    const std::unique_ptr<gpu::Context> context = makeContext(global);
    recipes::Renderer renderer(*context, request.scene);
    if (options.frames > 0) return renderFrames(options, request, renderer, global);
    writePicture(options.output, renderer.render(request.technique, request.settings));
    return kGood;
}

} // namespace

void addRenderCommand(CLI::App& app, const GlobalOptions& global, Run& run) {
    CLI::App* command = app.add_subcommand("render", "Renders a scene to a picture, or to a numbered sequence");
    auto options = std::make_shared<RenderOptions>();
    addFrameOptions(*command, options->frame, "");
    command
        ->add_option("-o,--output", options->output, "The picture: .exr is linear radiance, .png as a display shows it")
        ->type_name("FILE")
        ->required();
    command->add_option("--frames", options->frames, "Renders N pictures; FILE then holds a pattern such as f_%04d.png")
        ->type_name("N");
    command->add_option("--fps", options->framesPerSecond, "Frames a second of scene time [30]")->type_name("R");
    command->callback([options, &global, &run] { run = [options, &global] { return render(*options, global); }; });
}

} // namespace tessera::app
