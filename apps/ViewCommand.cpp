#include <spdlog/spdlog.h>

#include "apps/Commands.h"
#include "apps/FirstLook.h"
#include "base/Error.h"
#include "base/OneLine.h"
#include "viewer/Viewer.h"

namespace tessera::app {

namespace {

struct ViewOptions {
    FrameOptions frame;
    std::optional<std::string> window;
    bool log = false;
};

/// Reads the preferences of earlier runs. Warns of an unreadable file and does not overwrite it later.
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

int view(const ViewOptions& options, const GlobalOptions& global) {
    if (contextKind(global.context) == gpu::ContextKind::Egl)
        throw InputError("--context egl makes no window, and the viewer is one; give window or auto");
    const engine::ViewRequest said =
        resolveWithoutScene(options.frame); // mistakes end the program before there is a window
    viewer::ViewerOptions viewing;
    readPreferences(viewing);
    viewing.scene = options.frame.scene;
    viewing.load = loadOptionsOf(options.frame);
    viewing.log = options.log;
    viewing.warn = [](const std::string& text) { spdlog::warn("{}", oneLine(text)); };
    viewing.windowSize = viewing.preferences.windowSize.value_or(viewing.windowSize);
    if (options.window) viewing.windowSize = sizeNamed("--window", *options.window);
    if (options.frame.said("size") && !options.window) viewing.pictureSize = said.settings.sizePixels;
    viewing.lookOf = [&](const scenes::Scene& scene, const std::string& source, bool first) {
        return firstLook(first ? options.frame : forAnyScene(options.frame), viewing.preferences, scene, source);
    };
    viewer::runViewer(viewing);
    return kGood;
}

} // namespace

void addViewCommand(CLI::App& app, const GlobalOptions& global, Run& run) {
    CLI::App* command = app.add_subcommand("view", "Opens the interactive viewer");
    auto options = std::make_shared<ViewOptions>();
    addFrameOptions(*command, options->frame, "hall");
    command->get_option("--technique")
        ->description("The technique to begin with [the last one, clustered_deferred at first]");
    command->get_option("--size")->description(
        "Makes the window large enough for a picture of that size [as --window says]");
    command->add_option("--window", options->window, "Size of the window [its last size, 1280x800 at first]")
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
