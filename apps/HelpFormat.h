#pragma once
#include <memory>

#include <CLI/CLI.hpp>

namespace tessera::app {

/// Lays help out for people: required arguments are in the usage line, descriptions are wrapped, and a command's help
/// also lists the options of the program itself.
std::shared_ptr<CLI::Formatter> helpFormat();

} // namespace tessera::app
