#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace tessera::validation {

/// A figure in at most 8 characters: "0", "3.1e-07", or "-" for NaN.
std::string figureText(double value);
/// A fraction 0..1 as a percentage; 100 % and 0 % stand for exact values only.
std::string shareText(double share);
/// Decibels, or "-".
std::string decibelText(std::optional<double> decibel);
/// null for absent and non-finite values, which JSON cannot represent.
nlohmann::ordered_json figureJson(std::optional<double> value);

/// Formats rows of equally many cells as columns; the first `leftColumns` and the last are left-aligned.
std::string textTable(std::span<const std::vector<std::string>> rows, std::size_t leftColumns);

} // namespace tessera::validation
