#include <spdlog/spdlog.h>

#include "apps/Commands.h"
#include "scenes/Error.h"
#include "viewer/Viewer.h"

namespace tessera::app {

namespace {

struct ViewOptions {
    FrameOptions frame;
    std::optional<std::string> window;
    bool log = false;
};

/// Tiles and clusters answer input several times sooner than looping over all lights does.
constexpr recipes::Technique kFirstTechnique = recipes::Technique::ClusteredDeferred;

/// What was said on the command line and does not name things of the first scene.
FrameOptions forAnyScene(FrameOptions options) {
    options.camera.reset();
    options.pose = {};
    options.solo.reset();
    options.lights.reset();
    return options;
}

viewer::FirstLook lookOf(FrameOptions options, const scenes::Scene& scene, const std::string& source) {
    options.scene = source;
    Request request = resolveWithoutScene(options);
    request.scene.name = scene.name;
    request.scene.options = scene.options;
    request.scene.cameras = scene.cameras;
    request.scene.lights.resize(scene.lights.size()); // their number is all that is asked
    if (!options.technique) request.technique = kFirstTechnique;
    resolveForScene(options, request);
    return {viewer::possible({request.technique, request.settings}), options.pose};
}

/// Those of the latest runs. A file that cannot be read is said so, and left alone.
void readPreferences(viewer::ViewerOptions& viewing) {
    const auto file = viewer::preferencesFile();
    if (!file) return;
    try {
        viewing.preferences = viewer::readPreferences(*file);
        viewing.preferencesFile = file;
    } catch (const InputError& error) {
        spdlog::warn("{}", error.what());
    }
}

/// The options, with what is remembered where they say nothing. A remembered name that there is no more is dropped.
FrameOptions withRemembered(const FrameOptions& said, const viewer::Preferences& known) {
    FrameOptions options = said;
    const auto fill = [&options](auto member, const auto& value) {
        if (options.*member || !value) return;
        FrameOptions tried = options;
        tried.*member = *value;
        try {
            resolveWithoutScene(tried);
            options = tried;
        } catch (const InputError& error) {
            spdlog::debug("a remembered setting is left out: {}", error.what());
        }
    };
    fill(&FrameOptions::technique, known.technique);
    fill(&FrameOptions::layout, known.layout);
    fill(&FrameOptions::culling, known.culling);
    fill(&FrameOptions::tile, known.tile);
    fill(&FrameOptions::samples, known.samples);
    fill(&FrameOptions::toneMap, known.toneMap);
    return options;
}

int view(const ViewOptions& options, const GlobalOptions& global) {
    if (contextKind(global.context) == gpu::ContextKind::Egl)
        throw InputError("--context egl makes no window, and the viewer is one; give window or auto");
    resolveWithoutScene(options.frame); // mistakes end the program before there is a window
    viewer::ViewerOptions viewing;
    readPreferences(viewing);
    const FrameOptions frame = withRemembered(options.frame, viewing.preferences);
    viewing.scene = options.frame.scene;
    viewing.load.lights = options.frame.lights;
    viewing.load.defaultLight = !options.frame.noDefaultLight;
    viewing.log = options.log;
    viewing.windowSize = viewing.preferences.windowSize.value_or(viewing.windowSize);
    if (options.window) viewing.windowSize = sizeNamed(*options.window);
    if (options.frame.size && !options.window) viewing.pictureSize = sizeNamed(*options.frame.size);
    viewing.lookOf = [&frame](const scenes::Scene& scene, const std::string& source, bool first) {
        return lookOf(first ? frame : forAnyScene(frame), scene, source);
    };
    viewer::runViewer(viewing);
    return kGood;
}

} // namespace

void addViewCommand(CLI::App& app, const GlobalOptions& global, Run& run) {
    CLI::App* command = app.add_subcommand("view", "Opens the interactive viewer");
    auto options = std::make_shared<ViewOptions>();
    addFrameOptions(*command, options->frame, "hall");
    command->add_option("--window", options->window, "Size of the window [1280x800, or what the screen has]")
        ->type_name("WxH");
    command->add_flag("--log", options->log, "Prints a line for whatever happens, for programs that drive the viewer");
    command->footer(R"(Examples
  tessera view                                the default scene
  tessera view model.glb                      a model of your own
  tessera view hall --technique forward_plus  another technique to begin with
F1 in the window lists what keys and mouse do.)");
    command->callback([options, &global, &run] { run = [options, &global] { return view(*options, global); }; });
}

} // namespace tessera::app
