#pragma once
#include <CLI/CLI.hpp>

#include "apps/Options.h"

/// The program's commands. Each registers itself and its help with CLI11 and stores its work in `run`. main() calls
/// `run` after parsing; its result is the exit code.
namespace tessera::app {

using Run = std::function<int()>;

void addScenesCommand(CLI::App& app, Run& run);
void addRenderCommand(CLI::App& app, const GlobalOptions& global, Run& run);
void addCompareCommand(CLI::App& app, const GlobalOptions& global, Run& run);
void addPlanCommand(CLI::App& app, const GlobalOptions& global, Run& run);
void addBenchCommand(CLI::App& app, const GlobalOptions& global, Run& run);
void addStressCommand(CLI::App& app, const GlobalOptions& global, Run& run);
void addViewCommand(CLI::App& app, const GlobalOptions& global, Run& run);
void addDemoCommand(CLI::App& app, const GlobalOptions& global, Run& run);
/// These describe all commands, including those added later.
void addCompletionCommand(CLI::App& app, Run& run);
void addManualCommand(CLI::App& app, Run& run);

/// Exit codes of the documented command line.
inline constexpr int kGood = 0;
inline constexpr int kFailed = 1;
inline constexpr int kBadInput = 2;
inline constexpr int kToleranceMissed = 3;

} // namespace tessera::app
