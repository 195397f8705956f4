#include "renderer/culling/TileGrid.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tessera::culling {

TileGrid tileGrid(const FrameConstants& frame) {
    TileGrid grid;
    grid.columns = frame.lighting.tileGrid.x;
    grid.rows = frame.lighting.tileGrid.y;
    grid.sidePixels = 1u << frame.lighting.tileGrid.w;
    grid.sizePixels = frame.view.sizePixels;
    grid.rayFromPixel = frame.view.rayFromPixel;
    grid.spread = frame.view.forwardLS.w != 0.0f ? glm::vec2(1.0f, 0.0f) : glm::vec2(frame.view.eyeLS.w, 1.0f);
    return grid;
}

void setTileGrid(shared::LightingConstants& lighting, const shared::ViewConstants& view, int tilePixels) {
    const auto side = std::uint32_t(tilePixels);
    const glm::uvec2 size(view.sizePixels);
    lighting.tileGrid = glm::uvec4((size.x + side - 1) / side, (size.y + side - 1) / side, size.y,
                                   std::uint32_t(std::countr_zero(side)));
    // The 2^23 keys of one exponent cover a factor of two in distance, or the whole range of linear depths.
    const double tileWidth = double(tilePixels) * double(view.rayFromPixel.y);
    const double tileWidthThere = tileWidth * (view.forwardLS.w != 0.0f ? 1.0 : double(view.eyeLS.w));
    const bool isEven = view.depthKey.y > 0.0f;
    const double slices = isEven ? double(view.depthKey.y) / tileWidthThere : 1.0 / tileWidth;
    constexpr double kMantissaBits = 23.0;
    lighting.slices.x = std::uint32_t(std::clamp(kMantissaBits - std::round(std::log2(slices)), 5.0, 22.0));
}

} // namespace tessera::culling
