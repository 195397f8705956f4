#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace tessera::validation {

/// A figure in at most 8 characters: "0", "3.1e-07", or "-" for NaN.
std::string figureText(double value);
/// A share 0..1 as a percentage that reads 100 % or 0 % only when it is exactly that.
std::string shareText(double share);
/// Decibels, or "-".
std::string decibelText(std::optional<double> decibel);
/// null for absent and for non-finite values: JSON has no number for them.
nlohmann::ordered_json figureJson(std::optional<double> value);

/// Rows of equally many cells in aligned columns, the first `leftColumns` and the last one to the left.
std::string textTable(std::span<const std::vector<std::string>> rows, std::size_t leftColumns);

} // namespace tessera::validation
