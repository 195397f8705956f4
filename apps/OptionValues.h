#pragma once
#include <string>

#include "apps/CommandText.h"

namespace tessera::app {

/// Possible values of an option or operand of `command` (empty: the program): names from the library's tables, files or
/// folders.
ValueText valuesOf(const std::string& command, const OptionText& option);

} // namespace tessera::app
