#include "renderer/culling/TileGrid.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tessera::culling {

TileGrid tileGrid(const shared::FrameConstants& frame, glm::ivec2 sizePixels) {
    TileGrid grid;
    grid.columns = frame.tileGrid.x;
    grid.rows = frame.tileGrid.y;
    grid.sidePixels = 1u << frame.tileGrid.w;
    grid.sizePixels = glm::uvec2(sizePixels);
    grid.lensVS = frame.lensVS;
    grid.spread = frame.forwardLS.w != 0.0f ? glm::vec2(1.0f, 0.0f) : glm::vec2(frame.eyeLS.w, 1.0f);
    return grid;
}

void setTileGrid(shared::FrameConstants& frame, glm::ivec2 sizePixels, int tilePixels) {
    const auto side = std::uint32_t(tilePixels);
    const glm::uvec2 size(sizePixels);
    frame.tileGrid = glm::uvec4((size.x + side - 1) / side, (size.y + side - 1) / side, size.y,
                                std::uint32_t(std::countr_zero(side)));
    // A key's 2^k steps cover a factor of two in distance, or all of an even depth range.
    const double tileWidth = double(tilePixels) * double(frame.lensVS.y);
    const double tileWidthThere = tileWidth * (frame.forwardLS.w != 0.0f ? 1.0 : double(frame.eyeLS.w));
    const bool isEven = frame.depthKey.z > 0.0f;
    const double slices = isEven ? double(frame.depthKey.z) / tileWidthThere : 1.0 / tileWidth;
    constexpr double kMantissaBits = 23.0;
    frame.depthKey.y = float(std::clamp(kMantissaBits - std::round(std::log2(slices)), 5.0, 22.0));
}

} // namespace tessera::culling
