#pragma once
#include <string>

#include "apps/CommandText.h"

namespace tessera::app {

/// What can be given to an option, or to an operand, of a command (empty: the program): the names of the library's
/// tables, files or folders.
ValueText valuesOf(const std::string& command, const OptionText& option);

} // namespace tessera::app
