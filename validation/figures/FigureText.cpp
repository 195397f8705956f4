#include "validation/figures/FigureText.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tessera::validation {

std::string figureText(double value) {
    if (std::isnan(value)) return "-";
    return value == 0.0 ? "0" : fmt::format("{:.1e}", value);
}

std::string shareText(double share) {
    if (std::isnan(share)) return "-";
    if (share == 0.0 || share == 1.0) return fmt::format("{:.0f} %", 100.0 * share);
    // Three decimals, clamped so that 0 % and 100 % are printed for exact values only.
    return fmt::format("{:.3f} %", std::clamp(100.0 * share, 0.001, 99.999));
}

std::string decibelText(std::optional<double> decibel) {
    return decibel ? fmt::format("{:.1f} dB", *decibel) : "-";
}

nlohmann::ordered_json figureJson(std::optional<double> value) {
    if (!value || !std::isfinite(*value)) return nullptr;
    return *value;
}

std::string textTable(std::span<const std::vector<std::string>> rows, std::size_t leftColumns) {
    if (rows.empty()) return {};
    const std::size_t columns = rows.front().size();
    std::vector<std::size_t> widths(columns);
    for (const std::vector<std::string>& row : rows)
        for (std::size_t column = 0; column < columns; ++column)
            widths[column] = std::max(widths[column], row[column].size());
    std::string text;
    for (const std::vector<std::string>& row : rows) {
        for (std::size_t column = 0; column + 1 < columns; ++column)
            text += column < leftColumns ? fmt::format("{:<{}}  ", row[column], widths[column])
                                         : fmt::format("{:>{}}  ", row[column], widths[column]);
        text += row.back() + "\n";
    }
    return text;
}

} // namespace tessera::validation
