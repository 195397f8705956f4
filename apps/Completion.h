#pragma once
#include <span>
#include <string>
#include <string_view>

#include "apps/CommandText.h"

/// Shell completion scripts. They contain every command, option and keyword, so completion does not start the program.
namespace tessera::app {

std::string bashCompletion(const ProgramText& text);
std::string zshCompletion(const ProgramText& text);

struct ShellInfo {
    std::string_view name;
    std::string (*script)(const ProgramText& text);
};
std::span<const ShellInfo> shellTable();

} // namespace tessera::app
