#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/Commands.h"
#include "apps/FilterEnvironment.h"
#include "apps/FramePattern.h"
#include "apps/FrameSequence.h"
#include "apps/Numbers.h"
#include "apps/OnePicture.h"
#include "apps/Outputs.h"
#include "apps/Progress.h"
#include "apps/Shard.h"
#include "apps/Version.h"
#include "base/AtomicFile.h"
#include "base/Error.h"
#include "base/Extension.h"
#include "base/OneLine.h"
#include "base/PictureFile.h"
#include "engine/PrepareView.h"
#include "engine/Renderer.h"
#include "engine/Rendering.h"
#include "renderer/shader/SourceTree.h"
#include "scenes/Clips.h"
#include "scenes/Defaults.h"
#include "validation/compare/ReferencePicture.h"
#include "validation/pictures/ShownPicture.h"

namespace tessera::app {

namespace {

struct RenderOptions {
    FrameOptions frame;
    std::string output;
    std::optional<FrameRange> frames; ///< none: a single image
    std::optional<double> framesPerSecond;
    std::optional<std::string> shard;
    bool repeatsClip = false;
};

/// The work of a render command: a single image, or the frames of a sequence.
struct RenderJob {
    Request request;
    std::string scene;  ///< as the command line names it
    std::string output; ///< of a single image
    std::optional<FrameSequence> sequence;
    Outputs outputs;

    /// Number of images to render.
    std::size_t pictures() const { return sequence ? sequence->unfinished() : 1; }
    /// Poses the scene at a time of the sequence and returns the parts that may have moved. The scene of a single image
    /// is already posed.
    scenes::MovingParts pose(double timeSeconds) {
        if (!sequence || !scenes::isPlaying(request.scene)) return {};
        poseAt(request.scene, timeSeconds, scene);
        return scenes::movingParts(request.scene);
    }
    void make(const frame::FrameSettings& settings, const MakePicture& makePicture) {
        if (sequence) return sequence->draw(outputs, settings, makePicture);
        writeFileAtomically(outputs.at(output), makePicture(output, settings));
    }
};

/// Encodes an image in the format of the path's extension.
std::vector<std::uint8_t> encodedPicture(const std::string& path, const Request& request,
                                         const engine::Renderer& renderer, const engine::RenderedFrame& frame) {
    if (extensionOf(path) == ".exr") return encodeExr(engine::toPicture(frame));
    return encodePng(validation::shownPicture(frame, renderer.shadows(), request.scene.name, request.technique,
                                              request.settings.view))
        .bytes;
}

void requirePictureExtension(const std::string& path) {
    const std::string extension = extensionOf(path);
    if (extension != ".exr" && extension != ".png") {
        throw InputError(
            fmt::format("{}: pictures end in .exr (linear, 32 bit) or .png (as a display shows it)", path));
    }
}

/// Identifies the inputs of images besides the scene and the request: the program, its shaders and the renderer.
std::string makerText(const std::string& renderer) {
    const shader::SourceTree shaders;
    std::string text = fmt::format("{} {} {}", kCommit, renderer, shaders.describe());
    if (const auto change = shaders.newestChange()) text += fmt::format(" {}", change->time_since_epoch().count());
    // A build without a clean commit is identified by the modification time of its executable.
    std::error_code ignored;
    const std::string_view commit = kCommit;
    if (commit == "unknown" || commit.ends_with("-dirty"))
        text +=
            fmt::format(" {}", std::filesystem::last_write_time("/proc/self/exe", ignored).time_since_epoch().count());
    return text;
}

/// Warns of a faulty image (faultOf()); in a sequence only of the first.
void warnOfPicture(const std::string& path, const std::string& fault, bool& hasWarned) {
    if (fault.empty() || std::exchange(hasWarned, true)) return;
    spdlog::warn("{}", oneLine(path + ": " + fault));
}

/// Prints the scene's other cameras. Called after all checks, so that a mistake prints only its error.
void printCameras(const FrameOptions& options, const Request& request, bool isQuiet) {
    if (const std::string text = camerasText(options, request); !text.empty() && !isQuiet) fmt::print("{}\n", text);
}

/// Renders with the reference, without a context unless the scene's hook needs one.
void renderReference(const RenderOptions& options, RenderJob& job, const GlobalOptions& global) {
    frame::FrameSettings& settings = job.request.settings;
    settleForReference(options.frame, settings);
    const bool isLinear = extensionOf(options.output) == ".exr";
    job.pose(0.0); // makes the scene's fingerprint independent of --time
    if (job.sequence)
        job.sequence->leaveOutFinished(job.request, job.request.scene, makerText(std::string(kReferenceName)));
    if (job.pictures() == 0) return;
    printCameras(options.frame, job.request, global.quiet);
    Progress progress("rendering", job.pictures() * std::size_t(settings.sizePixels.y), global.quiet);
    for (const std::string& text : unusedByReference(options.frame, job.request)) spdlog::warn("{}", text);
    if (job.request.scene.environment && settings.environment.backdrop == frame::Backdrop::Blurred && !global.quiet)
        fmt::print("the reference shows the environment behind the scene as it is, without a blur\n");
    bool hasWarned = false;
    std::unique_ptr<gpu::Context> context;
    std::optional<engine::Renderer> renderer;
    if (job.request.scene.hook) {
        context = makeContext(global);
        renderer.emplace(*context, job.request.scene);
    }
    const auto rowDone = [&progress] { progress.advance(); };
    job.make(settings, [&](const std::string& path, const frame::FrameSettings& one) {
        const scenes::MovingParts moved = job.pose(one.timeSeconds);
        if (renderer) renderer->partsMoved(moved);
        Picture picture =
            renderer
                ? validation::referencePicture(*renderer, one, rowDone, validation::Alternatives::None).picture
                : validation::referencePicture(job.request.scene, one, rowDone, validation::Alternatives::None).picture;
        warnOfPicture(path, faultOf(job.request.scene, one.view, picture.rgba, ""), hasWarned);
        return isLinear ? encodeExr(picture) : encodePng(engine::toDisplayImage(picture, settings)).bytes;
    });
}

/// Checks the options of the output and the sequence. Returns the sequence if one is requested.
std::optional<FrameSequence> sequenceOf(const RenderOptions& options) {
    requirePictureExtension(options.output);
    if (!options.frames) {
        if (FramePattern::hasPlace(options.output))
            throw InputError(fmt::format("{}: has a place for a frame number; say with --frames how many pictures to "
                                         "render, or give another name",
                                         options.output));
        if (options.framesPerSecond) throw InputError("--fps needs --frames: how many pictures to render");
        if (options.repeatsClip) throw InputError("--loop needs --frames: how many pictures to render");
        if (options.shard) throw InputError("--shard needs --frames: how many pictures to render");
        requireWritable(options.output);
        return {};
    }
    FrameSequenceOptions sequence;
    sequence.pattern = options.output;
    sequence.range = *options.frames;
    if (options.framesPerSecond) sequence.framesPerSecond = *options.framesPerSecond;
    if (!(sequence.framesPerSecond > 0.0))
        throw InputError(fmt::format("--fps {} must be more than 0", sequence.framesPerSecond));
    if (options.shard) sequence.shard = shardNamed(*options.shard);
    sequence.repeatsClip = options.repeatsClip;
    std::optional<FrameSequence> frames(sequence);
    frames->requireWritable();
    return frames;
}

/// Prints notes on the active clip; warns if --loop has no clip to repeat.
void printClip(const RenderOptions& options, RenderJob& job, bool isQuiet) {
    const scenes::Scene& scene = job.request.scene;
    if (const std::string clip = scenes::clipText(scene); !clip.empty() && !isQuiet) fmt::print("{}\n", oneLine(clip));
    if (!job.sequence) return;
    const double clipSeconds = scenes::playingSeconds(scene.rig);
    job.sequence->takeClip(clipSeconds);
    if (const std::string behind = job.sequence->framesBehindClip(job.request.settings); !behind.empty() && !isQuiet)
        fmt::print("{}\n", behind);
    if (options.repeatsClip && clipSeconds == 0.0)
        spdlog::warn("--loop changes nothing. {}",
                     scenes::isPlaying(scene) ? "The clip is a pose without duration" : "No clip plays");
}

void renderByContext(const FrameOptions& frame, RenderJob& job, const GlobalOptions& global) {
    Request& request = job.request;
    engine::requireSupported(request);
    const std::unique_ptr<gpu::Context> context = makeContext(global);
    request.settings.display = extensionOf(job.output) != ".exr";
    job.pose(0.0); // as in renderReference()
    if (job.sequence)
        job.sequence->leaveOutFinished(
            request, request.scene,
            makerText(fmt::format("{} {}", context->capabilities().renderer, context->capabilities().version)));
    if (job.pictures() == 0) return;
    engine::Renderer renderer(*context, request.scene);
    printCameras(frame, request, global.quiet);
    filterEnvironment(request, renderer, global.quiet);
    // A single image is fast, except for diffusing subsurface irradiance, which has its own bar.
    Progress progress("rendering", job.pictures(), global.quiet || !job.sequence);
    std::optional<Progress> diffusion;
    if (!job.sequence)
        renderer.reportDiffusion([&](std::size_t done, std::size_t objects) {
            if (done == 0)
                diffusion.emplace("diffusing light over objects", objects, global.quiet);
            else
                diffusion->advance();
            if (done == objects) diffusion.reset();
        });
    bool hasWarned = false, hasWarnedOfShadows = false, hasWarnedOfTextures = false, hasWarnedOfDiffusion = false;
    std::optional<std::vector<std::string>> unused; // common to all images
    job.make(request.settings, [&](const std::string& path, const frame::FrameSettings& one) {
        renderer.partsMoved(job.pose(one.timeSeconds));
        const engine::RenderedFrame picture = renderer.render(request.technique, one);
        if (const std::string missing = renderer.missingTextures();
            !missing.empty() && !std::exchange(hasWarnedOfTextures, true))
            spdlog::warn("{}", oneLine(path + ": " + missing));
        if (const std::string unseen = renderer.invisibleDiffusion();
            !unseen.empty() && !std::exchange(hasWarnedOfDiffusion, true))
            spdlog::warn("{}", oneLine(path + ": " + unseen));
        const engine::DrawnShadows shadows = renderer.shadows();
        warnOfPicture(path, faultOf(request.scene, one.view, picture.radiance, shadows.cut), hasWarned);
        if (!shadows.missing.empty() && !std::exchange(hasWarnedOfShadows, true))
            spdlog::warn("{}", oneLine(path + ": " + shadows.missing));
        const std::vector<std::string> own = unusedSettings(
            frame, request, engine::prepareView(request.scene, request.technique, one), {&request.technique, 1});
        if (!unused) unused = own;
        std::erase_if(*unused, [&](const std::string& text) { return std::ranges::find(own, text) == own.end(); });
        progress.advance();
        return encodedPicture(path, request, renderer, picture);
    });
    for (const std::string& text : unused.value_or(std::vector<std::string>())) spdlog::warn("{}", text);
}

int render(const RenderOptions& options, const GlobalOptions& global) {
    RenderJob job;
    job.scene = options.frame.scene;
    job.output = options.output;
    job.sequence = sequenceOf(options);
    FrameOptions frame = options.frame;
    const bool isReference = frame.said("technique") == kReferenceName;
    if (isReference) frame.settings.erase("technique");
    job.request = resolve(frame);
    job.outputs = Outputs(job.sequence ? job.sequence->outputs() : std::vector{job.output});
    job.outputs.reads(job.request.files);
    printClip(options, job, global.quiet);
    if (const std::string supplied = scenes::suppliedText(job.request.scene); !supplied.empty() && !global.quiet)
        fmt::print("{}\n", supplied);
    for (const std::string& note : job.request.scene.notes)
        if (!global.quiet) fmt::print("{}\n", oneLine(note));
    if (isReference)
        renderReference(options, job, global);
    else
        renderByContext(frame, job, global);
    if (job.sequence && !global.quiet) fmt::print("{}\n", job.sequence->summary());
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
    command
        ->add_option_function<std::string>(
            "--frames", [options](const std::string& text) { options->frames = frameRangeNamed(text); },
            "Renders N pictures, or the frames A to B, or every Sth of these; FILE then holds a place such as "
            "f_%04d.png. Frames that the same options have made are not made again")
        ->type_name("N|A:B[:S]");
    addNumber(*command, "--fps", options->framesPerSecond,
              "Frames a second of scene time: frame k shows --time + k/R seconds [30]", "R");
    command->add_flag("--loop", options->repeatsClip,
                      "Begins the clip that plays again at its end, and with it all else that moves");
    command->add_option("--shard", options->shard, "Renders part I of N: every Nth frame, beginning with the Ith")
        ->type_name("I/N");
    command->footer(R"(Examples
  tessera render hall -o hall.png                       as a display shows it
  tessera render model.glb -o model.exr                 linear radiance, 32 bits a channel
  tessera render hall -o normals.png --view normal      what the lighting works with
  tessera render hall -o true.exr --technique reference by formulas in double precision
  tessera render scene.json -o f_%04d.png --frames 90   a sequence of 3 seconds
  tessera render scene.json -o f_%04d.png --frames 45:89 --shard 1/2 half of its second half)");
    command->callback([options, &global, &run] { run = [options, &global] { return render(*options, global); }; });
}

} // namespace tessera::app
