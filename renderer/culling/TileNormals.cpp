#include "renderer/culling/TileNormals.h"

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>

#include "shaders/shared/normals.h"

namespace tessera::culling {

namespace {

/// x, y, z in culling space; the fourth component pads to a SIMD vector.
using Direction = std::array<float, 4>;

/// Reads `width` bits of a pixel's words from bit `first` on; they may straddle two words.
std::uint32_t field(const std::uint32_t* pixel, unsigned first, unsigned width) {
    const std::uint32_t* const word = pixel + first / 32;
    const unsigned low = first % 32;
    const std::uint64_t both = low + width > 32 ? word[0] | std::uint64_t(word[1]) << 32 : word[0];
    return std::uint32_t(both >> low) & ((1u << width) - 1u);
}

// Decoded normals are in lighting space, with components of at most 1.
glm::vec3 decodeNormalCode(const std::uint32_t* pixel) {
    const glm::uvec2 shares(field(pixel, 0, NORMAL_SHARE_BITS), field(pixel, NORMAL_SHARE_BITS, NORMAL_SHARE_BITS));
    const std::uint32_t axis = field(pixel, 2 * NORMAL_SHARE_BITS, NORMAL_AXIS_BITS);
    return shared::directionOfShares(shares, axis) * (1.0f / NORMAL_SHARE_STEPS);
}
glm::vec3 decodeOctahedral(const std::uint32_t* pixel, const NormalEncoding& encoding) {
    const auto coordinate = [&](unsigned bit) {
        return shared::decodeSigned(field(pixel, bit, encoding.width), int(encoding.width));
    };
    return shared::directionOfOctahedral({coordinate(encoding.bit), coordinate(encoding.bit + encoding.width)});
}
glm::vec3 decodeVector(const std::uint32_t* pixel) {
    return {std::bit_cast<float>(pixel[0]), std::bit_cast<float>(pixel[1]), std::bit_cast<float>(pixel[2])};
}

template <typename Decode>
void decodeLine(const NormalPicture& normals, std::size_t first, std::size_t count, Direction* to, Decode&& decode) {
    const glm::mat3 turn = normals.cullingFromLighting;
    const std::uint32_t* const words = normals.words.data() + first * normals.wordsAPixel;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 n = decode(words + i * normals.wordsAPixel);
        to[i] = {turn[0][0] * n.x + turn[1][0] * n.y + turn[2][0] * n.z,
                 turn[0][1] * n.x + turn[1][1] * n.y + turn[2][1] * n.z,
                 turn[0][2] * n.x + turn[1][2] * n.y + turn[2][2] * n.z, n.x};
    }
}

void decodeLine(const NormalPicture& normals, std::size_t first, std::size_t count, Direction* to) {
    switch (normals.encoding.form) {
    case NormalForm::Code:
        return decodeLine(normals, first, count, to,
                          [](const std::uint32_t* pixel) { return decodeNormalCode(pixel); });
    case NormalForm::Octahedral:
        return decodeLine(normals, first, count, to,
                          [&](const std::uint32_t* pixel) { return decodeOctahedral(pixel, normals.encoding); });
    case NormalForm::Vector:
        return decodeLine(normals, first, count, to, [](const std::uint32_t* pixel) { return decodeVector(pixel); });
    }
}

struct Extremes {
    Direction low, high;

    void clear() {
        low.fill(2.0f);
        high.fill(-2.0f);
    }
    void add(const Direction& n) {
        for (std::size_t k = 0; k < n.size(); ++k) {
            low[k] = std::min(low[k], n[k]);
            high[k] = std::max(high[k], n[k]);
        }
    }
    NormalBounds bounds() const { return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}; }
};

/// Calls add(depth, normal) for each pixel of the tile that shows a surface.
template <typename Add>
void eachSurface(const SurfacePictures& pictures, const PixelRect& tile, Add&& add) {
    std::array<Direction, std::size_t(kTileSides[std::size(kTileSides) - 1])> line;
    const std::size_t columns = tile.right - tile.left;
    for (std::size_t y = tile.bottom; y < tile.top; ++y) {
        const std::size_t first = y * pictures.widthPixels + tile.left;
        decodeLine(pictures.normals, first, columns, line.data());
        for (std::size_t x = 0; x < columns; ++x)
            if (const float depth = pictures.depth[first + x]; depth > 0.0f) add(depth, line[x]);
    }
}

} // namespace

void findNormals(const SurfacePictures& pictures, const PixelRect& tile, std::vector<NormalBounds>& bounds) {
    Extremes all;
    all.clear();
    eachSurface(pictures, tile, [&](float, const Direction& n) { all.add(n); });
    bounds.assign(1, all.bounds());
}

void findNormalsBySlice(const SurfacePictures& pictures, const PixelRect& tile, const TileDepths& depths,
                        float depthBias, std::vector<NormalBounds>& bounds) {
    std::array<Extremes, LIGHT_TILE_SLICES> slices;
    const auto eachSlice = [&](auto&& visit) {
        for (std::uint64_t rest = depths.slices; rest != 0; rest &= rest - 1)
            visit(slices[std::size_t(std::countr_zero(rest))]);
    };
    eachSlice([](Extremes& slice) { slice.clear(); });
    eachSurface(pictures, tile, [&](float depth, const Direction& n) {
        slices[shared::sliceOfKey(std::bit_cast<std::uint32_t>(depthBias + depth), depths.slicing)].add(n);
    });
    bounds.clear();
    eachSlice([&](const Extremes& slice) { bounds.push_back(slice.bounds()); });
}

} // namespace tessera::culling
