#pragma once
#include <string>

#include "apps/CommandText.h"

namespace tessera::app {

/// The manual page, section 1, as man(7) reads it: what --help of the program and of every command says. Options that
/// commands share, word for word, stand once.
std::string manualPage(const ProgramText& text, const std::string& version);

} // namespace tessera::app
