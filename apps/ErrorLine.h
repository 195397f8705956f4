#pragma once
#include <string_view>

namespace tessera::app {

/// Writes "tessera: TEXT" as one line (oneLine()) to stderr. A failure is ignored: there is no other place to tell it.
void printProblem(std::string_view text);

} // namespace tessera::app
