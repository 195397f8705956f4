#include <charconv>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "scenes/write/ElementJson.h"

namespace tessera::scenes::write {
namespace {

template <typename Number>
Json shortestDegrees(Number angleRadians) {
    const double degrees = glm::degrees(static_cast<double>(angleRadians));
    double candidate = degrees;
    for (int digits = 1; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
        const std::string text = fmt::format("{:.{}g}", degrees, digits);
        std::from_chars(text.data(), text.data() + text.size(), candidate);
        if (glm::radians(static_cast<Number>(candidate)) == angleRadians) break;
    }
    return candidate;
}

} // namespace

Json degreesOf(float angleRadians) {
    return shortestDegrees(angleRadians);
}

Json degreesOf(double angleRadians) {
    return shortestDegrees(angleRadians);
}

} // namespace tessera::scenes::write
