#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace tessera::validation {

/// A figure in typeset notation: 3.1 x 10 to the -7, with a real minus sign; a dash for NaN.
std::string figureHtml(double value);
std::string figureHtml(const std::optional<double>& value);
/// A fraction 0..1 as a percentage; a dash for NaN.
std::string shareHtml(double share);
/// A whole number with thousands separators: 389,128.
std::string countText(std::uint64_t count);

} // namespace tessera::validation
