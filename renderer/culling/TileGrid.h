#pragma once
#include <cstdint>

#include "shaders/shared/culling.h"
#include "shaders/shared/frame.h"

namespace tessera::culling {

/// The constants of a view that culling reads.
struct FrameConstants {
    const shared::ViewConstants& view;
    const shared::LightingConstants& lighting;
};

/// The tile grid of an image; tile (0, 0) is at the top left.
struct TileGrid {
    std::uint32_t columns = 0, rows = 0;
    std::uint32_t sidePixels = 0;
    glm::uvec4 sizePixels{0u}; ///< ViewConstants::sizePixels
    glm::vec4 rayFromPixel{0.0f};
    glm::vec2 spread{0.0f}; ///< ray spread (shaders/shared/culling.h)

    glm::vec4 rays(std::uint32_t column, std::uint32_t row) const {
        return shared::tileRays(rayFromPixel, column, row, sidePixels, sizePixels);
    }
};
TileGrid tileGrid(const FrameConstants& frame);

/// Sets the tile grid and the finest depth slices: about as deep as a tile is wide, so that cells are near cubes.
void setTileGrid(shared::LightingConstants& lighting, const shared::ViewConstants& view, int tilePixels);

} // namespace tessera::culling
