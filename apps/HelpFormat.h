#pragma once
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

namespace tessera::app {

/// Lays help out for people: required arguments are in the usage line, descriptions are wrapped, and a command's help
/// also lists the options of the program itself.
std::shared_ptr<CLI::Formatter> helpFormat();

/// "tessera render SCENE -o FILE [options]" for the command, or the program, that is called `name`.
std::string usageOf(const CLI::App& app, const std::string& name);

} // namespace tessera::app
