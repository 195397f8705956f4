#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/Commands.h"
#include "apps/FilterEnvironment.h"
#include "apps/FramePattern.h"
#include "apps/Numbers.h"
#include "apps/Outputs.h"
#include "apps/Progress.h"
#include "base/AtomicFile.h"
#include "base/Error.h"
#include "base/Extension.h"
#include "base/OneLine.h"
#include "base/PictureFile.h"
#include "engine/PrepareView.h"
#include "engine/Renderer.h"
#include "engine/Rendering.h"
#include "validation/compare/ReferencePicture.h"
#include "validation/pictures/ShownPicture.h"

namespace tessera::app {

namespace {

constexpr double kFramesPerSecond = 30.0;
constexpr int kMostFrames = 1'000'000; ///< their names are all known before the first is written

struct RenderOptions {
    FrameOptions frame;
    std::string output;
    std::optional<int> frames; ///< none: one picture
    std::optional<double> framesPerSecond;
};

/// `path` is one of the outputs.
void writePicture(const std::string& path, const Request& request, const engine::Renderer& renderer,
                  const engine::RenderedFrame& frame) {
    if (extensionOf(path) == ".exr") {
        writeExr(path, engine::toPicture(frame));
    } else {
        writePng(path, validation::shownPicture(frame, renderer.shadows(), request.scene.name, request.technique,
                                                request.settings.view));
    }
}

void requirePictureExtension(const std::string& path) {
    const std::string extension = extensionOf(path);
    if (extension != ".exr" && extension != ".png") {
        throw InputError(
            fmt::format("{}: pictures end in .exr (linear, 32 bit) or .png (as a display shows it)", path));
    }
}

std::vector<std::string> outputsOf(const RenderOptions& options) {
    if (!options.frames) return {options.output};
    std::vector<std::string> outputs;
    const FramePattern pattern(options.output);
    for (int i = 0; i < *options.frames; ++i) outputs.push_back(pattern.path(i));
    return outputs;
}

/// Says why, where a picture (RGBA, A the share of a pixel that is covered) shows nothing of its scene or is black, and
/// how many of its pixels are no numbers; of a sequence about the first such picture alone. `cut` says how shadows may
/// have made pixels NaN, or nothing.
void warnOfPicture(const std::string& path, const scenes::Scene& scene, frame::DebugView view,
                   const std::vector<float>& rgba, const std::string& cut, bool& hasWarned) {
    std::size_t covered = 0, bad = 0;
    bool hasNaN = false;
    bool isBlack = view == frame::DebugView::Final && !scene.lights.empty(); // without lights that is no surprise
    for (std::size_t pixel = 0; pixel < rgba.size(); pixel += 4) {
        covered += rgba[pixel + 3] > 0.0f;
        bad += !(std::isfinite(rgba[pixel]) && std::isfinite(rgba[pixel + 1]) && std::isfinite(rgba[pixel + 2]));
        hasNaN = hasNaN || std::isnan(rgba[pixel]);
        isBlack = isBlack && rgba[pixel] == 0.0f && rgba[pixel + 1] == 0.0f && rgba[pixel + 2] == 0.0f;
    }
    if ((covered > 0 && bad == 0 && !isBlack) || std::exchange(hasWarned, true)) return;
    std::string why = "the camera sees nothing of the scene; check --eye, --target, --near and --far; backs of "
                      "one-sided surfaces and triangles without area do not show";
    if (scenes::triangleCount(scene) == 0) why = "the scene has no triangles to draw";
    if (covered > 0)
        why = "is black: no light reaches the surfaces in view; --view diffuse shows them without light, and lights "
              "may be out of range, behind the surfaces or off";
    if (bad > 0)
        why = fmt::format("{} of its pixels are infinite or no numbers; {}", bad,
                          hasNaN && !cut.empty() ? cut : "a light is too bright or too near");
    spdlog::warn("{}", oneLine(path + ": " + why));
}

/// Makes one picture at a path.
using MakePicture = std::function<void(const std::string& path, const frame::FrameSettings& settings)>;

/// One picture, or a sequence in which frame i shows the time start + i / fps.
void makePictures(const RenderOptions& options, const Outputs& outputs, frame::FrameSettings settings,
                  const MakePicture& make) {
    if (!options.frames) return make(outputs.at(options.output), settings);
    const FramePattern pattern(options.output);
    const double start = settings.timeSeconds;
    for (int i = 0; i < *options.frames; ++i) {
        settings.timeSeconds = start + i / options.framesPerSecond.value_or(kFramesPerSecond);
        make(outputs.at(pattern.path(i)), settings);
    }
}

/// Without a context: the display picture has exposure and sRGB alone.
void renderReference(const RenderOptions& options, const Outputs& outputs, const Request& request,
                     const GlobalOptions& global) {
    frame::FrameSettings settings = request.settings;
    // As compare does; hardware filtering is available on request.
    if (!options.frame.said("filter")) settings.filter = frame::TextureFilter::Exact;
    validation::requireReferenceTakes(settings);
    const bool isLinear = extensionOf(options.output) == ".exr";
    if (!isLinear && settings.toneMap != frame::ToneMap::None)
        throw InputError("--technique reference has no tone maps; give --tonemap none, or write .exr");
    Progress progress("rendering", std::size_t(options.frames.value_or(1)) * std::size_t(settings.sizePixels.y),
                      global.quiet);
    for (const engine::Setting& setting : engine::settingTable())
        if (setting.panel == engine::SettingPanel::Shadows && setting.key != "shadows" &&
            options.frame.said(setting.key))
            spdlog::warn("{} changes nothing. The reference follows rays of its own", setting.flag);
    bool hasWarned = false;
    makePictures(options, outputs, settings, [&](const std::string& path, const frame::FrameSettings& one) {
        Picture picture = validation::referencePicture(
                              request.scene, one, [&progress] { progress.advance(); }, validation::Leeway::None)
                              .picture;
        warnOfPicture(path, request.scene, one.view, picture.rgba, "", hasWarned);
        if (isLinear) return writeExr(path, picture);
        for (float& value : picture.rgba) value *= std::exp2(settings.exposureEV);
        writePng(path, toDisplayImage(picture));
    });
}

void check(const RenderOptions& options) {
    requirePictureExtension(options.output);
    if (!options.frames && FramePattern::hasPlace(options.output))
        throw InputError(fmt::format(
            "{}: has a place for a frame number; say with --frames how many pictures to render, or give another name",
            options.output));
    if (options.framesPerSecond && !options.frames)
        throw InputError("--fps needs --frames: how many pictures to render");
    if (options.frames && *options.frames < 1)
        throw InputError(fmt::format("--frames {} is less than one picture", *options.frames));
    if (options.frames && *options.frames > kMostFrames)
        throw InputError(fmt::format("--frames {} is more than {} pictures; render fewer at a time, from --time S on",
                                     *options.frames, kMostFrames));
    if (options.framesPerSecond && !(*options.framesPerSecond > 0.0))
        throw InputError(fmt::format("--fps {} must be more than 0", *options.framesPerSecond));
    requireWritable(options.frames ? FramePattern(options.output).path(0) : options.output);
}

int render(const RenderOptions& options, const GlobalOptions& global) {
    check(options);
    FrameOptions frame = options.frame;
    const bool isReference = frame.said("technique") == kReferenceName;
    if (isReference) frame.settings.erase("technique");
    Request request = resolve(frame);
    Outputs outputs(outputsOf(options));
    outputs.reads(request.files);
    if (isReference) {
        renderReference(options, outputs, request, global);
        return kGood;
    }
    engine::requireTaken(request);
    const std::unique_ptr<gpu::Context> context = makeContext(global);
    engine::Renderer renderer(*context, request.scene);
    request.settings.display = extensionOf(options.output) != ".exr";
    filterEnvironment(request, renderer, global.quiet);
    // One picture is soon made.
    Progress progress("rendering", std::size_t(options.frames.value_or(1)), global.quiet || !options.frames);
    bool hasWarned = false, hasWarnedOfShadows = false;
    std::optional<std::vector<std::string>> unheeded; // in all pictures
    makePictures(options, outputs, request.settings, [&](const std::string& path, const frame::FrameSettings& one) {
        const engine::RenderedFrame picture = renderer.render(request.technique, one);
        const engine::DrawnShadows shadows = renderer.shadows();
        warnOfPicture(path, request.scene, one.view, picture.radiance, shadows.cut, hasWarned);
        if (!shadows.missing.empty() && !std::exchange(hasWarnedOfShadows, true))
            spdlog::warn("{}", oneLine(path + ": " + shadows.missing));
        const std::vector<std::string> own =
            unheededShadows(frame, request, engine::prepareView(request.scene, request.technique, one));
        if (!unheeded) unheeded = own;
        std::erase_if(*unheeded, [&](const std::string& text) { return std::ranges::find(own, text) == own.end(); });
        writePicture(path, request, renderer, picture);
        progress.advance();
    });
    for (const std::string& text : unheeded.value_or(std::vector<std::string>())) spdlog::warn("{}", text);
    return kGood;
}

} // namespace

void addRenderCommand(CLI::App& app, const GlobalOptions& global, Run& run) {
    CLI::App* command = app.add_subcommand("render", "Renders a scene to a picture, or to a numbered sequence");
    auto options = std::make_shared<RenderOptions>();
    addFrameOptions(*command, options->frame, "");
    CLI::Option* technique = command->get_option("--technique");
    technique->description(fmt::format("{}; or {}, which renders by formulas in double precision",
                                       technique->get_description(), kReferenceName));
    command
        ->add_option("-o,--output", options->output, "The picture: .exr is linear radiance, .png as a display shows it")
        ->type_name("FILE")
        ->required();
    addWholeNumber(*command, "--frames", options->frames,
                   "Renders N pictures; FILE then holds a place such as f_%04d.png", "N");
    addNumber(*command, "--fps", options->framesPerSecond, "Frames a second of scene time [30]", "R");
    command->footer(R"(Examples
  tessera render hall -o hall.png                       as a display shows it
  tessera render model.glb -o model.exr                 linear radiance, 32 bits a channel
  tessera render hall -o normals.png --view normal      what the lighting works with
  tessera render hall -o true.exr --technique reference by formulas in double precision
  tessera render scene.json -o f_%04d.png --frames 90   a sequence of 3 seconds)");
    command->callback([options, &global, &run] { run = [options, &global] { return render(*options, global); }; });
}

} // namespace tessera::app
