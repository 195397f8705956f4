#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "renderer/culling/TileDepths.h"

namespace tessera::culling {

/// A rectangle of pixels. Rows count from the bottom; right and top are exclusive.
struct PixelRect {
    std::size_t left, right, bottom, top;
};

/// Component-wise bounds of normals in culling space. Normals keep their stored length: above 0, at most the half
/// diagonal of the cube [-1, 1]^3.
struct NormalBounds {
    glm::vec3 low, high;
};

/// Bounds the normals of a tile's visible surfaces; replaces `bounds`.
void findNormals(const SurfacePictures& pictures, const PixelRect& tile, std::vector<NormalBounds>& bounds);

/// The same per occupied slice of the tile, farthest first. `depthBias` is the bias of depth keys.
void findNormalsBySlice(const SurfacePictures& pictures, const PixelRect& tile, const TileDepths& depths,
                        float depthBias, std::vector<NormalBounds>& bounds);

} // namespace tessera::culling
