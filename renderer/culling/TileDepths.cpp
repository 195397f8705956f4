#include "renderer/culling/TileDepths.h"

#include <algorithm>
#include <bit>

namespace tessera::culling {

namespace {

/// Nearest and farthest depth of pixel i; equal for one depth a pixel.
struct PixelDepths {
    float nearest, farthest;
};
template <bool kIsRange>
PixelDepths pixelDepths(const float* depth, std::size_t i) {
    if constexpr (kIsRange)
        return {depth[2 * i], -depth[2 * i + 1]};
    else
        return {depth[i], depth[i]};
}

struct PixelRows {
    int left, right, bottom, top; ///< right and top are one beyond
};

PixelRows pixelsOf(const FrameConstants& frame, int column, int row) {
    const int widthPixels = int(frame.view.sizePixels.x);
    const int side = 1 << frame.lighting.tileGrid.w;
    const int height = int(frame.lighting.tileGrid.z);
    return {column * side, std::min((column + 1) * side, widthPixels), std::max(0, height - (row + 1) * side),
            height - row * side};
}

std::uint64_t bitsFromTo(std::uint32_t first, std::uint32_t last) {
    return (~std::uint64_t(0) >> (63 - (last - first))) << first;
}

template <bool kIsRange>
TileDepths tileDepthsOf(const float* depth, const FrameConstants& frame, const PixelRows& pixels) {
    const std::size_t widthPixels = frame.view.sizePixels.x;
    TileDepths tile;
    tile.farthest = 2.0f;
    for (int y = pixels.bottom; y < pixels.top; ++y) {
        const std::size_t start = std::size_t(y) * widthPixels;
        for (int x = pixels.left; x < pixels.right; ++x) {
            const PixelDepths d = pixelDepths<kIsRange>(depth, start + std::size_t(x));
            tile.nearest = std::max(tile.nearest, d.nearest);
            if (d.nearest > 0.0f) tile.farthest = std::min(tile.farthest, d.farthest);
        }
    }
    if (!(tile.nearest > 0.0f)) return {};

    const float bias = frame.view.depthKey.x;
    const std::uint32_t low = std::bit_cast<std::uint32_t>(bias + tile.farthest);
    const std::uint32_t high = std::bit_cast<std::uint32_t>(bias + tile.nearest);
    tile.slicing = shared::slicingOf(low, high, frame.lighting.slices.x, LIGHT_TILE_SLICES);
    if (shared::sliceOfKey(high, tile.slicing) == 0) {
        tile.slices = 1;
        return tile;
    }
    for (int y = pixels.bottom; y < pixels.top; ++y) {
        const std::size_t start = std::size_t(y) * widthPixels;
        for (int x = pixels.left; x < pixels.right; ++x) {
            const PixelDepths d = pixelDepths<kIsRange>(depth, start + std::size_t(x));
            if (!(d.nearest > 0.0f)) continue;
            const std::uint32_t last = shared::sliceOfKey(std::bit_cast<std::uint32_t>(bias + d.nearest), tile.slicing);
            if constexpr (kIsRange) {
                const std::uint32_t first =
                    shared::sliceOfKey(std::bit_cast<std::uint32_t>(bias + d.farthest), tile.slicing);
                tile.slices |= bitsFromTo(first, last);
            } else {
                tile.slices |= std::uint64_t(1) << last;
            }
        }
    }
    return tile;
}

DepthRun runBetween(float nearest, float farthest, const FrameConstants& frame) {
    return {shared::aheadMetres(frame.view.aheadFromDepth, nearest),
            shared::aheadMetres(frame.view.aheadFromDepth, farthest)};
}

} // namespace

TileDepths tileDepths(const DepthPicture& picture, const FrameConstants& frame, int column, int row) {
    const PixelRows pixels = pixelsOf(frame, column, row);
    return picture.isRange ? tileDepthsOf<true>(picture.depth.data(), frame, pixels)
                           : tileDepthsOf<false>(picture.depth.data(), frame, pixels);
}

DepthRun depthRun(const TileDepths& tile, const FrameConstants& frame) {
    return runBetween(tile.nearest, tile.farthest, frame);
}

DepthRun depthRun(const TileDepths& tile, int firstSlice, int lastSlice, const FrameConstants& frame) {
    const glm::vec2 depths = shared::depthsOfSlices(tile.slicing, std::uint32_t(firstSlice), std::uint32_t(lastSlice),
                                                    frame.view.depthKey.x);
    return runBetween(std::min(tile.nearest, depths.y), std::max(tile.farthest, depths.x), frame);
}

} // namespace tessera::culling
