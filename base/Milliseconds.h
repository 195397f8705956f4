#pragma once
#include <string>

namespace tessera {

/// Formats milliseconds with three significant digits, as an integer from 1000 on, never in scientific notation:
/// "0.0123", "12.3", "6750". The caller appends the unit.
std::string millisecondsText(double milliseconds);

} // namespace tessera
