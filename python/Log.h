#pragma once
#include <string>
#include <vector>

namespace tessera::python {

/// From now on what the library warns of is kept, for Python's warnings, instead of printed.
void keepLog();
/// What was warned of since the last call.
std::vector<std::string> takeLog();

} // namespace tessera::python
