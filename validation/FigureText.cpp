#include "validation/FigureText.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace tessera::validation {

std::string figureText(double value) {
    if (std::isnan(value)) return "-";
    return value == 0.0 ? "0" : fmt::format("{:.1e}", value);
}

std::string shareText(double share) {
    if (std::isnan(share)) return "-";
    if (share == 0.0 || share == 1.0) return fmt::format("{:.0f} %", 100.0 * share);
    // Three decimals, kept off both ends, which are promises.
    return fmt::format("{:.3f} %", std::clamp(100.0 * share, 0.001, 99.999));
}

std::string decibelText(std::optional<double> decibel) {
    return decibel ? fmt::format("{:.1f} dB", *decibel) : "-";
}

} // namespace tessera::validation
