#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace tessera::validation {

/// A figure as print sets it: 3.1 x 10 to the -7, with a real minus; a dash for NaN.
std::string figureHtml(double value);
std::string figureHtml(const std::optional<double>& value);
/// A share 0..1 as a percentage; a dash for NaN.
std::string shareHtml(double share);
/// A whole number with its thousands apart: 389,128.
std::string countText(std::uint64_t count);

} // namespace tessera::validation
