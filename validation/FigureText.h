#pragma once
#include <optional>
#include <string>

namespace tessera::validation {

/// A figure in at most 8 characters: "0", "3.1e-07", or "-" for NaN.
std::string figureText(double value);
/// A share 0..1 as a percentage that reads 100 % or 0 % only when it is exactly that.
std::string shareText(double share);
/// Decibels, or "-".
std::string decibelText(std::optional<double> decibel);

} // namespace tessera::validation
