#pragma once
#include <cstdint>

#include "shaders/shared/culling.h"
#include "shaders/shared/frame.h"

namespace tessera::culling {

/// What culling knows of a view.
struct FrameConstants {
    const shared::ViewConstants& view;
    const shared::LightingConstants& lighting;
};

/// The tiles of a picture; (0, 0) is its top left one.
struct TileGrid {
    std::uint32_t columns = 0, rows = 0;
    std::uint32_t sidePixels = 0;
    glm::uvec4 sizePixels{0u}; ///< as ViewConstants has it
    glm::vec4 rayFromPixel{0.0f};
    glm::vec2 spread{0.0f}; ///< of rays, as shaders/shared/culling.h has it

    glm::vec4 rays(std::uint32_t column, std::uint32_t row) const {
        return shared::tileRays(rayFromPixel, column, row, sidePixels, sizePixels);
    }
};
TileGrid tileGrid(const FrameConstants& frame);

/// Sets the grid of tiles, and the finest slices of depth: about as deep as a tile is wide, so that cells are cubes.
void setTileGrid(shared::LightingConstants& lighting, const shared::ViewConstants& view, int tilePixels);

} // namespace tessera::culling
