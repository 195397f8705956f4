#include "scenes/builtin/hall/Textures.h"

#include <algorithm>
#include <cmath>

#include "scenes/builtin/Noise.h"
#include "scenes/builtin/Pictures.h"

namespace tessera::scenes::builtin::hall {
namespace {

constexpr int kSize = 512;

/// Texture space 0..1.
glm::dvec2 texelCenter(int x, int y, int width, int height) {
    return {(x + 0.5) / width, (y + 0.5) / height};
}

/// Noise that tiles over the image, `frequency` cells across.
double tiling(const glm::dvec2& p, int frequency, int octaves, std::uint32_t seed) {
    return fractalNoise({frequency * p.x, frequency * p.y, 0.0}, octaves, seed, glm::ivec2(frequency));
}

/// 1 on a vein of marble, 0 away from it: where a warped noise crosses zero.
double vein(const glm::dvec2& p, int frequency, double width, std::uint32_t seed) {
    const double warp = 0.12 * tiling(p, 4, 2, seed);
    const double n = tiling(p + warp, frequency, 3, seed + 11);
    return std::exp(-(n * n) / (width * width));
}

/// Distance to the edge of the nearest of `count` slabs per side, in texture space.
double toSlabEdge(const glm::dvec2& p, int count) {
    const glm::dvec2 inside = glm::fract(p * static_cast<double>(count));
    const glm::dvec2 edge = glm::min(inside, 1.0 - inside) / static_cast<double>(count);
    return std::min(edge.x, edge.y);
}

// ---- Floor: 2 x 2 slabs, a diamond inlaid where four meet ----

constexpr int kSlabs = 2;
constexpr double kJoint = 0.004;

/// Signed distance to the inlaid diamonds at the slabs' corners, negative inside.
double toInlay(const glm::dvec2& p) {
    const glm::dvec2 fromCorner =
        glm::abs(glm::fract(p * static_cast<double>(kSlabs) + 0.5) - 0.5) / static_cast<double>(kSlabs);
    return (fromCorner.x + fromCorner.y - 0.11) / std::sqrt(2.0);
}

double toJoint(const glm::dvec2& p) {
    const double inlay = toInlay(p);
    return inlay < 0.0 ? -inlay : std::min(inlay, toSlabEdge(p, kSlabs));
}

// ---- Ashlar: four courses of two blocks, every second one shifted ----

struct Block {
    double toEdge; ///< in texture space
    double shade;  ///< 0..1, random per block
    double lean;   ///< -1..1
};

Block blockAt(const glm::dvec2& p) {
    constexpr int kCourses = 4;
    constexpr int kBlocks = 2;
    const int course = static_cast<int>(std::floor(p.y * kCourses));
    const double x = p.x * kBlocks + 0.5 * (course % 2);
    const int block = static_cast<int>(std::floor(x)) % kBlocks;
    const double fx = x - std::floor(x);
    const double fy = p.y * kCourses - course;
    const double edge = std::min(std::min(fx, 1.0 - fx) / kBlocks, std::min(fy, 1.0 - fy) / kCourses);
    return {edge, hashUnit(block, course, 0, 3), 2.0 * hashUnit(block, course, 1, 3) - 1.0};
}

} // namespace

Image floorColors() {
    constexpr glm::dvec3 kLight(0.62, 0.57, 0.50);
    constexpr glm::dvec3 kDark(0.10, 0.115, 0.13);
    constexpr glm::dvec3 kInlay(0.30, 0.07, 0.05);
    constexpr glm::dvec3 kGrout(0.09, 0.08, 0.07);
    return drawColors("floor colours", kSize, kSize, [&](int x, int y) {
        const glm::dvec2 p = texelCenter(x, y, kSize, kSize);
        const glm::ivec2 slab(glm::floor(p * static_cast<double>(kSlabs)));
        const bool dark = (slab.x + slab.y) % 2 == 1;
        const double cloud = tiling(p, 5, 3, 41);
        glm::dvec3 color = dark ? kDark * (1.0 + 0.5 * cloud) : kLight * (1.0 + 0.16 * cloud);
        color = glm::mix(color, dark ? glm::dvec3(0.45, 0.44, 0.42) : glm::dvec3(0.30, 0.26, 0.23),
                         0.55 * vein(p, 3, 0.05, 43));
        if (toInlay(p) < 0.0) color = kInlay * (1.0 + 0.4 * cloud);
        return glm::mix(kGrout, color, glm::smoothstep(0.5 * kJoint, kJoint, toJoint(p)));
    });
}

Image floorRoughness() {
    constexpr int kHalf = kSize / 2;
    return drawValues("floor roughness", kHalf, kHalf, [&](int x, int y) {
        const glm::dvec2 p = texelCenter(x, y, kHalf, kHalf);
        const glm::ivec2 slab(glm::floor(p * static_cast<double>(kSlabs)));
        const double polish = (slab.x + slab.y) % 2 == 1 ? 0.16 : 0.24;
        const double worn = polish + 0.06 * std::abs(tiling(p, 6, 2, 47));
        return glm::dvec3(0.0, glm::mix(0.75, worn, glm::smoothstep(0.5 * kJoint, 2.0 * kJoint, toJoint(p))), 0.0);
    });
}

Image floorNormals() {
    const double texelMetres = static_cast<double>(kFloorTextureMetres) / kSize;
    return normalsFromHeights("floor normals", kSize, texelMetres, [&](int x, int y) {
        const glm::dvec2 p = texelCenter(x, y, kSize, kSize);
        return 0.0022 * glm::smoothstep(0.3 * kJoint, 1.6 * kJoint, toJoint(p)) + 0.0009 * tiling(p, 3, 1, 49);
    });
}

Image ashlarColors() {
    constexpr glm::dvec3 kStone(0.46, 0.40, 0.33);
    constexpr glm::dvec3 kMortar(0.25, 0.22, 0.19);
    return drawColors("ashlar colours", kSize, kSize, [&](int x, int y) {
        const glm::dvec2 p = texelCenter(x, y, kSize, kSize);
        const Block block = blockAt(p);
        const double grain = 0.14 * tiling(p, 6, 3, 53) + 0.08 * tiling(p, 48, 1, 54);
        const glm::dvec3 own = kStone * (0.86 + 0.26 * block.shade) + glm::dvec3(0.02, 0.0, -0.02) * block.lean;
        return glm::mix(kMortar, own * (1.0 + grain), glm::smoothstep(0.004, 0.009, block.toEdge));
    });
}

Image ashlarNormals() {
    const double texelMetres = static_cast<double>(kAshlarTextureMetres) / kSize;
    return normalsFromHeights("ashlar normals", kSize, texelMetres, [&](int x, int y) {
        const glm::dvec2 p = texelCenter(x, y, kSize, kSize);
        const Block block = blockAt(p);
        const double cushion = 0.012 * glm::smoothstep(0.003, 0.022, block.toEdge);
        const double hewn = 0.008 * tiling(p, 12, 2, 57) + 0.0018 * tiling(p, 64, 1, 58);
        return cushion + hewn + 0.006 * block.lean * glm::smoothstep(0.003, 0.02, block.toEdge);
    });
}

Image marbleColors() {
    return drawColors("marble colours", kSize, kSize, [&](int x, int y) {
        const glm::dvec2 p = texelCenter(x, y, kSize, kSize);
        const double cloud = tiling(p, 3, 3, 61);
        glm::dvec3 color = glm::dvec3(0.72, 0.70, 0.67) * (1.0 + 0.14 * cloud);
        color = glm::mix(color, {0.33, 0.34, 0.37}, 0.6 * vein(p, 3, 0.045, 63));
        return glm::mix(color, {0.50, 0.40, 0.30}, 0.4 * vein(p, 5, 0.03, 67));
    });
}

Image mosaicNormals() {
    constexpr int kStones = 16;
    constexpr int kMosaicSize = 256;
    return drawNormals("mosaic normals", kMosaicSize, kMosaicSize, [&](int x, int y) {
        const glm::dvec2 p = texelCenter(x, y, kMosaicSize, kMosaicSize) * static_cast<double>(kStones);
        const glm::ivec2 stone(glm::floor(p));
        const glm::dvec2 tilt(hashUnit(stone.x, stone.y, 0, 71) - 0.5, hashUnit(stone.x, stone.y, 1, 71) - 0.5);
        // Rounded edges: the normal turns outwards over the last tenth.
        const glm::dvec2 inside = 2.0 * (p - glm::dvec2(stone)) - 1.0;
        const glm::dvec2 rim = glm::sign(inside) * glm::smoothstep(glm::dvec2(0.75), glm::dvec2(1.0), glm::abs(inside));
        return glm::normalize(glm::dvec3(0.5 * tilt.x + 0.6 * rim.x, 0.5 * tilt.y - 0.6 * rim.y, 1.0));
    });
}

Image carpetColors() {
    constexpr int kWidth = 256;
    constexpr int kHeight = 256;
    constexpr glm::dvec3 kRed(0.62, 0.04, 0.045);
    constexpr glm::dvec3 kDeep(0.20, 0.012, 0.03);
    constexpr glm::dvec3 kGold(0.80, 0.50, 0.14);
    return drawColors("carpet", kWidth, kHeight, [&](int x, int y) {
        const glm::dvec2 p = texelCenter(x, y, kWidth, kHeight);
        const double edge = std::min(p.x, 1.0 - p.x);
        const glm::dvec2 q(4.0 * (p.x - 0.5), 2.0 * glm::fract(2.0 * p.y) - 1.0); // one medallion per half of v
        const double medallion = std::abs(q.x) + std::abs(q.y);
        glm::dvec3 color = medallion < 0.8 ? kDeep : kRed;
        if (std::abs(medallion - 0.8) < 0.04 || medallion < 0.16) color = kGold;
        if (edge < 0.12)
            color = std::abs(glm::fract(8.0 * p.y) - 0.5) + 6.0 * std::abs(edge - 0.07) < 0.3 ? kGold : kDeep;
        if (edge < 0.02 || std::abs(edge - 0.12) < 0.008) color = kGold;
        return color * (0.85 + 0.3 * hashUnit(x, y, 0, 73));
    });
}

Image bannerColors(const std::string& name, const glm::dvec3& field) {
    constexpr int kWidth = 128;
    constexpr int kHeight = 256;
    constexpr glm::dvec3 kGold(0.78, 0.5, 0.13);
    return drawColors(name + " banner", kWidth, kHeight, [&](int x, int y) {
        const glm::dvec2 p = texelCenter(x, y, kWidth, kHeight);
        const double edge = std::min({p.x, 1.0 - p.x, 2.2 * (1.0 - p.y), 2.2 * p.y});
        // A sun: a disc and a ring of twelve rays.
        const glm::dvec2 q(2.0 * p.x - 1.0, 4.5 * (p.y - 0.38));
        const double radius = glm::length(q);
        const double rays = 0.5 + 0.5 * std::cos(12.0 * std::atan2(q.y, q.x));
        const bool sun = radius < 0.28 || (radius > 0.34 && radius < 0.42 + 0.2 * rays * rays);
        const bool border = edge > 0.05 && edge < 0.1;
        const double weave = 0.9 + 0.2 * hashUnit(x, y, 0, 79);
        return (sun || border ? kGold : field) * weave;
    });
}

} // namespace tessera::scenes::builtin::hall
