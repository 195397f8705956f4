#pragma once
#include <string>

#include <CLI/CLI.hpp>

namespace tessera::app {

/// What is wrong with the command that the words name; empty where they name one that there is, or none.
std::string unknownCommandOf(const CLI::App& app, int argc, const char* const* argv);

/// One line for an error of the parser: it names the word, the nearest valid ones and where to read more.
std::string parseMessage(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv);

} // namespace tessera::app
