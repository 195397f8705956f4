#pragma once
#include <cstdint>

#include <glm/glm.hpp>

/// Smooth random functions for textures and fine relief, the same on every machine.
namespace tessera::scenes::builtin {

/// Random value of a grid point or cell, 0 <= value < 1.
double hashUnit(int x, int y, int z, std::uint32_t seed);

/// Gradient noise after Perlin 2002, "Improving noise": 0 at the integer points, about -1..1 between. x and y repeat
/// with `period` (whole numbers; 0: never), so that a texture can tile.
double gradientNoise(const glm::dvec3& point, std::uint32_t seed, const glm::ivec2& period = glm::ivec2(0));

/// Sum of `octaves` of gradient noise, each of twice the frequency and half the weight, normalised to about -1..1.
double fractalNoise(const glm::dvec3& point, int octaves, std::uint32_t seed, const glm::ivec2& period = glm::ivec2(0));

} // namespace tessera::scenes::builtin
