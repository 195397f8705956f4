#include "scenes/builtin/Noise.h"

#include <array>
#include <cmath>

namespace tessera::scenes::builtin {
namespace {

/// Mixes all bits of four words; the multipliers and shifts are those of MurmurHash3's finaliser (Appleby 2011).
std::uint32_t hashWord(int x, int y, int z, std::uint32_t seed) {
    std::uint32_t h = seed;
    for (const int word : {x, y, z}) {
        h = (h ^ static_cast<std::uint32_t>(word)) * 0x9E3779B1u; // 2^32 / golden ratio
        h ^= h >> 15;
    }
    h ^= h >> 16;
    h *= 0x85EBCA6Bu;
    h ^= h >> 13;
    h *= 0xC2B2AE35u;
    h ^= h >> 16;
    return h;
}

/// Dot product of `offset` with one of the twelve directions to the middles of a cube's edges.
double gradientDot(std::uint32_t hash, const glm::dvec3& offset) {
    const auto axis = static_cast<glm::length_t>((hash >> 2) % 3);
    const double a = offset[axis];
    const double b = offset[(axis + 1) % 3];
    return ((hash & 1u) != 0 ? -a : a) + ((hash & 2u) != 0 ? -b : b);
}

double fade(double t) {
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

int wrapped(int i, int period) {
    if (period == 0) return i;
    const int rest = i % period;
    return rest < 0 ? rest + period : rest;
}

} // namespace

double hashUnit(int x, int y, int z, std::uint32_t seed) {
    return hashWord(x, y, z, seed) / 4294967296.0;
}

double gradientNoise(const glm::dvec3& point, std::uint32_t seed, const glm::ivec2& period) {
    const glm::dvec3 base = glm::floor(point);
    const glm::dvec3 f = point - base;
    const glm::ivec3 cell(base);
    const std::array<int, 2> x = {wrapped(cell.x, period.x), wrapped(cell.x + 1, period.x)};
    const std::array<int, 2> y = {wrapped(cell.y, period.y), wrapped(cell.y + 1, period.y)};
    const auto corner = [&](int i, int j, int k) {
        const auto hash = hashWord(x[static_cast<std::size_t>(i)], y[static_cast<std::size_t>(j)], cell.z + k, seed);
        return gradientDot(hash, f - glm::dvec3(i, j, k));
    };
    const glm::dvec3 w(fade(f.x), fade(f.y), fade(f.z));
    const auto edge = [&](int j, int k) { return glm::mix(corner(0, j, k), corner(1, j, k), w.x); };
    if (f.z == 0.0) return glm::mix(edge(0, 0), edge(1, 0), w.y); // a plane of grid points: the next has no weight
    return glm::mix(glm::mix(edge(0, 0), edge(1, 0), w.y), glm::mix(edge(0, 1), edge(1, 1), w.y), w.z);
}

double fractalNoise(const glm::dvec3& point, int octaves, std::uint32_t seed, const glm::ivec2& period) {
    double sum = 0.0;
    double weight = 1.0;
    double weights = 0.0;
    glm::dvec3 p = point;
    glm::ivec2 repeat = period;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += weight * gradientNoise(p, seed + static_cast<std::uint32_t>(octave), repeat);
        weights += weight;
        weight *= 0.5;
        p *= 2.0;
        repeat *= 2;
    }
    return sum / weights;
}

} // namespace tessera::scenes::builtin
