#pragma once
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "apps/Request.h"

/// What the command line says.
namespace tessera::app {

/// Options of the program itself, before or after the command.
struct GlobalOptions {
    bool quiet = false;
    bool verbose = false;
    std::string context = "auto";
};
void addGlobalOptions(CLI::App& app, GlobalOptions& options);
std::unique_ptr<gpu::Context> makeContext(const GlobalOptions& options);

/// All but the scene.
void addFrameSettings(CLI::App& command, FrameOptions& options);
/// The scene, which is required where `defaultScene` is empty, and the rest.
void addFrameOptions(CLI::App& command, FrameOptions& options, const std::string& defaultScene);

} // namespace tessera::app
