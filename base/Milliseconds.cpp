#include "base/Milliseconds.h"

#include <fmt/format.h>

namespace tessera {

std::string millisecondsText(double milliseconds) {
    constexpr double kThousand = 999.5; // from here on, three digits round to 1e+03
    constexpr double kShortest = 1e-4;  // below, three digits are in scientific notation too
    if (milliseconds >= kThousand) return fmt::format("{:.0f}", milliseconds);
    return milliseconds < kShortest ? "0" : fmt::format("{:.3g}", milliseconds);
}

} // namespace tessera
