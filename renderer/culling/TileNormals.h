#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "renderer/culling/TileDepths.h"

namespace tessera::culling {

/// Columns and lines of pixels, lines from the bottom; right and top are one beyond.
struct PixelRect {
    std::size_t left, right, bottom, top;
};

/// The normals of some surfaces, in culling space. They are as long as they are stored: longer than 0 and up to a
/// cube's half diagonal.
struct NormalBounds {
    glm::vec3 low, high;
};

/// Bounds the normals of what a tile shows, in place of `bounds`.
void findNormals(const SurfacePictures& pictures, const PixelRect& tile, std::vector<NormalBounds>& bounds);

/// The same for each of a tile's occupied slices, the farthest first. `depthBias` is that of depth keys.
void findNormalsBySlice(const SurfacePictures& pictures, const PixelRect& tile, const TileDepths& depths,
                        float depthBias, std::vector<NormalBounds>& bounds);

} // namespace tessera::culling
