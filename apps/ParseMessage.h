#pragma once
#include <string>

#include <CLI/CLI.hpp>

namespace tessera::app {

/// Message on an unknown command name; empty if the command exists or none is named.
std::string unknownCommandOf(const CLI::App& app, int argc, const char* const* argv);

/// One-line message for a parse error: names the word, the nearest valid ones and the help to read.
std::string parseMessage(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv);

} // namespace tessera::app
