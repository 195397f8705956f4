#pragma once
#include <string_view>

namespace tessera::app {

/// Writes "tessera: TEXT" as one line (oneLine()) to stderr. Write errors are ignored: nothing else could report them.
void printProblem(std::string_view text);

} // namespace tessera::app
