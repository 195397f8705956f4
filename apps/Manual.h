#pragma once
#include <string>

#include "apps/CommandText.h"

namespace tessera::app {

/// The manual page, section 1, in man(7) format: the --help texts of the program and of every command. Options that
/// commands share verbatim are listed once.
std::string manualPage(const ProgramText& text, const std::string& version);

} // namespace tessera::app
