#include "renderer/frame/LobeShapes.h"

#include <iterator>

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

} // namespace tessera::frame
