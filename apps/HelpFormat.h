#pragma once
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

namespace tessera::app {

/// Help formatter: required arguments are in the usage line, descriptions are wrapped, and a command's help also lists
/// the program's options.
std::shared_ptr<CLI::Formatter> helpFormat();

/// Usage line of the command or program called `name`: "tessera render SCENE -o FILE [options]".
std::string usageOf(const CLI::App& app, const std::string& name);

} // namespace tessera::app
