#include "scenes/builtin/models/Textures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/builtin/Noise.h"
#include "scenes/builtin/Pictures.h"

namespace tessera::scenes::builtin::models {
namespace {

constexpr int kSize = 256;
constexpr double kTurn = 2.0 * std::numbers::pi;

glm::dvec2 texelCenter(int x, int y) {
    return {(x + 0.5) / kSize, (y + 0.5) / kSize};
}

double tiling(const glm::dvec2& p, int frequency, int octaves, std::uint32_t seed) {
    return fractalNoise({frequency * p.x, frequency * p.y, 0.0}, octaves, seed, glm::ivec2(frequency));
}

/// The nearest of points scattered one per cell, with `cells` cells per side.
struct Nearest {
    glm::ivec2 cell{0};
    double distance = 2.0; ///< in cells
    double second = 2.0;   ///< distance to the second nearest
};

Nearest nearestPoint(const glm::dvec2& p, int cells, std::uint32_t seed) {
    const glm::dvec2 at = p * static_cast<double>(cells);
    Nearest nearest;
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            const glm::ivec2 cell(static_cast<int>(std::floor(at.x)) + i, static_cast<int>(std::floor(at.y)) + j);
            const glm::ivec2 wrapped((cell.x + cells) % cells, (cell.y + cells) % cells);
            const glm::dvec2 point = glm::dvec2(cell) + glm::dvec2(hashUnit(wrapped.x, wrapped.y, 0, seed),
                                                                   hashUnit(wrapped.x, wrapped.y, 1, seed));
            const double distance = glm::distance(at, point);
            if (distance < nearest.distance) {
                nearest.second = nearest.distance;
                nearest.distance = distance;
                nearest.cell = wrapped;
            } else {
                nearest.second = std::min(nearest.second, distance);
            }
        }
    }
    return nearest;
}

/// A twill: whether the thread on top runs along u, and where across it the point lies, -1..1.
struct Thread {
    bool alongU = false;
    double across = 0.0;
};

Thread twill(const glm::dvec2& p, int threads) {
    const glm::dvec2 at = p * static_cast<double>(threads);
    const int column = static_cast<int>(std::floor(at.x));
    const int row = static_cast<int>(std::floor(at.y));
    const bool alongU = (column + row) % 4 < 2;
    const double inside = alongU ? at.y - row : at.x - column;
    return {alongU, 2.0 * inside - 1.0};
}

constexpr int kFibres = 32;
constexpr int kClothThreads = 64;

/// encoded as a texel
glm::dvec3 storedDirection(double angleRadians, double strength) {
    return {0.5 + 0.5 * std::cos(angleRadians), 0.5 + 0.5 * std::sin(angleRadians), strength};
}

} // namespace

Image terrazzoColors() {
    constexpr glm::dvec3 kGround(0.72, 0.68, 0.60);
    constexpr glm::dvec3 kChips[] = {{0.55, 0.16, 0.08}, {0.10, 0.22, 0.24}, {0.80, 0.55, 0.18}, {0.30, 0.28, 0.26}};
    return drawColors("terrazzo", kSize, kSize, [&](int x, int y) {
        const glm::dvec2 p = texelCenter(x, y);
        const Nearest chip = nearestPoint(p + 0.01 * tiling(p, 16, 2, 5), 9, 31);
        const double size = 0.22 + 0.25 * hashUnit(chip.cell.x, chip.cell.y, 2, 31);
        if (chip.distance > size || chip.second - chip.distance < 0.08)
            return kGround * (1.0 + 0.08 * tiling(p, 32, 2, 7));
        return kChips[static_cast<int>(4.0 * hashUnit(chip.cell.x, chip.cell.y, 3, 31))];
    });
}

Image lanternColors() {
    constexpr glm::dvec3 kPaper(1.0, 0.62, 0.26);
    constexpr glm::dvec3 kRib(0.30, 0.10, 0.03);
    return drawColors("lantern", kSize, kSize, [&](int x, int y) {
        const glm::dvec2 p = texelCenter(x, y);
        const double rib = std::pow(std::abs(std::cos(0.5 * kTurn * 9.0 * p.y)), 40.0);
        const double glow = 0.45 + 0.55 * std::pow(std::sin(0.5 * kTurn * p.y), 2.0);
        return glm::mix(kPaper * glow * (1.0 + 0.06 * tiling(p, 24, 3, 3)), kRib, rib);
    });
}

Image glazeColors() {
    return drawColors("glaze", kSize, kSize, [](int x, int y) {
        const glm::dvec2 p = texelCenter(x, y);
        const double wave = std::sin(kTurn * (5.0 * p.y + 0.12 * std::sin(3.0 * kTurn * p.x)));
        const double glossy = std::clamp(0.5 + 4.0 * wave, 0.0, 1.0);
        return glm::mix(glm::dvec3(0.03), glm::dvec3(1.0, 0.92, 0.75), glossy);
    });
}

Image swirlDirections() {
    return drawValues("swirls", kSize, kSize, [](int x, int y) {
        constexpr int kCells = 2; // swirls per side
        const glm::dvec2 at = texelCenter(x, y) * static_cast<double>(kCells);
        const glm::dvec2 fromCentre = glm::fract(at) - 0.5;
        const double strength = std::clamp(12.0 * glm::length(fromCentre), 0.0, 1.0);
        // Along the circle about the centre; v points down in the image and up in tangent space.
        return storedDirection(std::atan2(fromCentre.x, fromCentre.y), strength);
    });
}

Image fibreColors() {
    return drawColors("fibres", kSize, kSize, [](int x, int y) {
        const Thread thread = twill(texelCenter(x, y), kFibres);
        return glm::dvec3(0.012 + 0.03 * (1.0 - thread.across * thread.across));
    });
}

Image fibreDirections() {
    return drawValues("fibre directions", kSize, kSize, [](int x, int y) {
        return storedDirection(twill(texelCenter(x, y), kFibres).alongU ? 0.25 * kTurn : 0.0, 1.0);
    });
}

Image flakeNormals() {
    return drawNormals("flakes", kSize, kSize, [](int x, int y) {
        const Nearest flake = nearestPoint(texelCenter(x, y), 96, 17);
        const double tilt = 0.30 * hashUnit(flake.cell.x, flake.cell.y, 2, 17);
        const double turn = kTurn * hashUnit(flake.cell.x, flake.cell.y, 3, 17);
        return glm::normalize(glm::dvec3(tilt * std::cos(turn), tilt * std::sin(turn), 1.0));
    });
}

Image peelNormals() {
    constexpr double kMetres = 0.25; // size that the texture covers
    return normalsFromHeights("lacquer", kSize, kMetres / kSize,
                              [](int x, int y) { return 0.0005 * tiling(texelCenter(x, y), 12, 2, 23); });
}

Image clothColors() {
    constexpr glm::dvec3 kBlue(0.03, 0.06, 0.16);
    constexpr glm::dvec3 kSand(0.55, 0.40, 0.24);
    const auto dyed = [&](double along) { return std::fmod(4.0 * along, 1.0) < 0.28 ? kSand : kBlue; };
    return drawColors("cloth", kSize, kSize, [&](int x, int y) {
        const glm::dvec2 p = texelCenter(x, y);
        const Thread thread = twill(p, kClothThreads);
        return dyed(thread.alongU ? p.y : p.x) * (1.0 - 0.5 * thread.across * thread.across);
    });
}

Image clothNormals() {
    constexpr double kMetres = 0.5; // size that the texture covers
    return normalsFromHeights("cloth relief", kSize, kMetres / kSize, [](int x, int y) {
        const Thread thread = twill(texelCenter(x, y), kClothThreads);
        return 0.0012 * std::sqrt(1.0 - 0.9 * thread.across * thread.across);
    });
}

Image fuzzRoughness() {
    // drawValues leaves alpha at 1, so the channel is filled here.
    Image image = drawValues("fuzz", kSize, kSize, [](int, int) { return glm::dvec3(1.0); });
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const double share = std::clamp(0.7 + 0.5 * tiling(texelCenter(x, y), 6, 3, 41), 0.0, 1.0);
            image.texels[static_cast<std::size_t>(4 * (y * kSize + x) + 3)] =
                static_cast<std::byte>(std::lround(255.0 * share));
        }
    }
    return image;
}

Image glowColors() {
    constexpr glm::dvec3 kEmber(1.0, 0.28, 0.05);
    return drawColors("cracks", kSize, kSize, [&](int x, int y) {
        const glm::dvec2 p = texelCenter(x, y);
        const Nearest plate = nearestPoint(p + 0.02 * tiling(p, 8, 2, 53), 5, 57);
        return kEmber * std::exp(-30.0 * (plate.second - plate.distance));
    });
}

} // namespace tessera::scenes::builtin::models
