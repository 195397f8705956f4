#include "renderer/frame/LobeShapes.h"

#include <algorithm>
#include <cmath>

#include "shaders/shared/lobe_shapes.h"

namespace tessera::frame {

namespace {

constexpr glm::vec4 kShapes[] = {
#include "renderer/frame/lobe_shapes.inc"
};
static_assert(std::size(kShapes) == std::size_t(LOBE_SHAPES_SIDE) * LOBE_SHAPES_SIDE);

} // namespace

std::span<const glm::vec4> lobeShapes() {
    return kShapes;
}

glm::dmat3 inverseShape(double alpha, double cosView) {
    constexpr double kLast = LOBE_SHAPES_SIDE - 1;
    alpha = std::clamp(alpha, double(LOBE_SHAPES_SMALLEST_ALPHA), 1.0);
    cosView = std::clamp(cosView, double(LOBE_SHAPES_SMALLEST_COSINE), 1.0);
    const double right = kLast * std::sqrt(cosView), up = kLast * std::sqrt(alpha);
    const double column = std::min(std::floor(right), kLast - 1.0), row = std::min(std::floor(up), kLast - 1.0);
    const auto between = [&](double y) {
        const glm::vec4* entry = kShapes + std::size_t(y * LOBE_SHAPES_SIDE + column);
        return glm::mix(glm::dvec4(entry[0]), glm::dvec4(entry[1]), right - column);
    };
    const glm::dvec4 numbers = glm::mix(between(row), between(row + 1.0), up - row);
    const double sineView = std::sqrt(1.0 - cosView * cosView);
    return shared::inverseOfShape(glm::vec4(numbers), float(alpha), float(cosView), float(sineView));
}

} // namespace tessera::frame
