#include "validation/pictures/ErrorScale.h"

#include <algorithm>
#include <cmath>

#include "shaders/shared/heat.h"

namespace tessera::validation {
namespace {

std::uint8_t codeValue(float value) {
    return std::uint8_t(std::lround(255.0f * value));
}

} // namespace

Rgb8 scaleColour(double position) {
    const glm::vec3 color = shared::heatColor(float(position));
    return {codeValue(color.r), codeValue(color.g), codeValue(color.b)};
}

double scalePosition(double rel) {
    if (!(rel > 0.0)) return 0.0;
    return std::clamp(1.0 - std::log10(rel) / double(kErrorScaleLowExponent), 0.0, 1.0);
}

} // namespace tessera::validation
