#pragma once
#include <string>

namespace tessera::validation {

/// "2 x AMD EPYC 7763, Linux x86_64".
std::string machineName();

} // namespace tessera::validation
