#pragma once
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "apps/Request.h"

/// The options on the command line.
namespace tessera::app {

/// Options of the program itself, before or after the command.
struct GlobalOptions {
    bool quiet = false;
    bool verbose = false;
    std::string context = "auto";
};
void addGlobalOptions(CLI::App& app, GlobalOptions& options);
std::unique_ptr<gpu::Context> makeContext(const GlobalOptions& options);

/// Adds all frame options except the scene.
void addFrameSettings(CLI::App& command, FrameOptions& options);
/// Adds all frame options. The scene is required if `defaultScene` is empty.
void addFrameOptions(CLI::App& command, FrameOptions& options, const std::string& defaultScene);

} // namespace tessera::app
