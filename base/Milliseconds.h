#pragma once
#include <string>

namespace tessera {

/// A time in milliseconds to three digits, or to a whole one from 1000 on, never as a power of ten: "0.0123", "12.3",
/// "6750". Its unit is written behind it.
std::string millisecondsText(double milliseconds);

} // namespace tessera
