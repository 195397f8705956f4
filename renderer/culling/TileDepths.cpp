#include "renderer/culling/TileDepths.h"

#include <algorithm>
#include <bit>

namespace tessera::culling {

namespace {

/// Nearest and farthest depth of pixel i; equal where a pixel has one depth.
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

/// The pixel rows of a row of tiles, counted from the bottom.
struct PixelLines {
    const float* depth;
    std::size_t widthPixels;
    int bottom, top; ///< top is exclusive
};

/// Pixel columns processed together: a multiple of every tile side.
constexpr int kBlockColumns = 64;

/// Depth range of each pixel column of a block, over a row of tiles. Loops run along pixel rows, so that they vectorise
/// over columns; a reduction over the pixels of one tile would depend on its previous step.
struct ColumnDepths {
    float nearest[kBlockColumns];
    float farthest[kBlockColumns];
};

template <bool kIsRange>
void findColumnDepths(const PixelLines& pixels, std::size_t left, int columns, ColumnDepths& found) {
    std::fill_n(found.nearest, columns, 0.0f);
    std::fill_n(found.farthest, columns, 2.0f);
    for (int y = pixels.bottom; y < pixels.top; ++y) {
        const std::size_t start = std::size_t(y) * pixels.widthPixels + left;
        for (int i = 0; i < columns; ++i) {
            const PixelDepths d = pixelDepths<kIsRange>(pixels.depth, start + std::size_t(i));
            const float farthest = d.nearest > 0.0f ? d.farthest : 2.0f;
            found.nearest[i] = std::max(found.nearest[i], d.nearest);
            found.farthest[i] = std::min(found.farthest[i], farthest);
        }
    }
}

std::uint64_t bitsFromTo(std::uint32_t first, std::uint32_t last) {
    return (~std::uint64_t(0) >> (63 - (last - first))) << first;
}

/// Bit s: a surface of these columns lies in slice s.
template <bool kIsRange>
std::uint64_t occupiedSlices(const PixelLines& pixels, std::size_t left, int columns, float bias,
                             std::uint32_t slicing) {
    const auto sliceOf = [&](float depth) {
        return shared::sliceOfKey(std::bit_cast<std::uint32_t>(bias + depth), slicing);
    };
    std::uint64_t slices = 0;
    std::uint32_t nearest[kBlockColumns];
    for (int y = pixels.bottom; y < pixels.top; ++y) {
        const std::size_t start = std::size_t(y) * pixels.widthPixels + left;
        for (int i = 0; i < columns; ++i)
            nearest[i] = sliceOf(pixelDepths<kIsRange>(pixels.depth, start + std::size_t(i)).nearest);
        for (int i = 0; i < columns; ++i) {
            const PixelDepths d = pixelDepths<kIsRange>(pixels.depth, start + std::size_t(i));
            if constexpr (kIsRange) {
                if (d.nearest > 0.0f) slices |= bitsFromTo(sliceOf(d.farthest), nearest[i]);
            } else {
                slices |= std::uint64_t(d.nearest > 0.0f) << (nearest[i] & 63u);
            }
        }
    }
    return slices;
}

template <bool kIsRange>
void findTileDepths(const PixelLines& pixels, const FrameConstants& frame, std::span<TileDepths> tiles) {
    const int side = 1 << frame.lighting.tileGrid.w;
    const float bias = frame.view.depthKey.x;
    ColumnDepths found;
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        const std::size_t left = t * std::size_t(side);
        const int inBlock = int(left % kBlockColumns);
        if (inBlock == 0) {
            const std::size_t columns = std::min<std::size_t>(kBlockColumns, pixels.widthPixels - left);
            findColumnDepths<kIsRange>(pixels, left, int(columns), found);
        }
        const int columns = int(std::min<std::size_t>(std::size_t(side), pixels.widthPixels - left));
        TileDepths tile;
        tile.nearest = *std::max_element(found.nearest + inBlock, found.nearest + inBlock + columns);
        tile.farthest = *std::min_element(found.farthest + inBlock, found.farthest + inBlock + columns);
        tiles[t] = {};
        if (!(tile.nearest > 0.0f)) continue;
        const std::uint32_t low = std::bit_cast<std::uint32_t>(bias + tile.farthest);
        const std::uint32_t high = std::bit_cast<std::uint32_t>(bias + tile.nearest);
        tile.slicing = shared::slicingOf(low, high, frame.lighting.slices.x, LIGHT_TILE_SLICES);
        tile.slices = shared::sliceOfKey(high, tile.slicing) == 0
                          ? 1
                          : occupiedSlices<kIsRange>(pixels, left, columns, bias, tile.slicing);
        tiles[t] = tile;
    }
}

} // namespace

void findTileDepths(const DepthPicture& picture, const FrameConstants& frame, int row, std::span<TileDepths> tiles) {
    const int side = 1 << frame.lighting.tileGrid.w;
    const int height = int(frame.lighting.tileGrid.z);
    const PixelLines pixels{picture.depth.data(), frame.view.sizePixels.x, std::max(0, height - (row + 1) * side),
                            height - row * side};
    if (picture.isRange)
        findTileDepths<true>(pixels, frame, tiles);
    else
        findTileDepths<false>(pixels, frame, tiles);
}

} // namespace tessera::culling
