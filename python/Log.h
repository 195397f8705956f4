#pragma once
#include <string>
#include <vector>

namespace tessera::python {

/// From now on keeps the library's warnings, to be issued as Python warnings, instead of printing them.
void keepLog();
/// Removes and returns the kept warnings.
std::vector<std::string> takeLog();

} // namespace tessera::python
