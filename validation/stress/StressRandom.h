#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include <glm/glm.hpp>

namespace tessera::validation {

/// Random numbers that are equal on all platforms: std::mt19937_64 is specified to the last bit, the distributions of
/// <random> are not.
class StressRandom {
public:
    explicit StressRandom(std::uint64_t seed) : engine_(seed) {}

    double unit() { return double(engine_() >> 11) * 0x1p-53; } ///< 0 <= u < 1
    double between(double low, double high) { return low + (high - low) * unit(); }
    double logarithmic(double low, double high) { return low * std::pow(high / low, unit()); } ///< both > 0
    int index(int count) { return int(unit() * count); }
    double sign() { return index(2) == 0 ? 1.0 : -1.0; }
    glm::vec3 color() { return {unit(), unit(), unit()}; }

    /// Uniform over the sphere.
    glm::dvec3 direction() { return around({0.0, 0.0, 1.0}, between(-1.0, 1.0)); }

    /// A direction at this cosine to `axis`, with random azimuth.
    glm::dvec3 around(const glm::dvec3& axis, double cosine) {
        const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const glm::dvec3 t = glm::normalize(glm::cross(axis, other)), b = glm::cross(axis, t);
        const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
        const double phi = between(0.0, 2.0 * std::numbers::pi);
        return t * (sine * std::cos(phi)) + b * (sine * std::sin(phi)) + axis * cosine;
    }

private:
    std::mt19937_64 engine_;
};

} // namespace tessera::validation
