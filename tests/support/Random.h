#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include <glm/glm.hpp>

namespace tessera::test {

using std::numbers::pi;

/// Deterministic random numbers (std::mt19937_64 is specified to the last bit; the distributions of <random> are not).
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double unit() { return double(engine_() >> 11) * 0x1p-53; } ///< 0 <= x < 1
    double between(double low, double high) { return low + (high - low) * unit(); }
    double logarithmic(double low, double high) { return low * std::pow(high / low, unit()); }
    int index(int count) { return int(unit() * count); }
    glm::dvec3 direction() {
        const double z = between(-1.0, 1.0), phi = between(0.0, 2.0 * pi), r = std::sqrt(std::max(0.0, 1.0 - z * z));
        return {r * std::cos(phi), r * std::sin(phi), z};
    }
    /// A random direction around n, with n.w between the two cosines.
    glm::dvec3 around(const glm::dvec3& n, double minCosine, double maxCosine) {
        const glm::dvec3 other = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const glm::dvec3 t = glm::normalize(glm::cross(n, other)), b = glm::cross(n, t);
        const double c = between(minCosine, maxCosine), s = std::sqrt(std::max(0.0, 1.0 - c * c)),
                     phi = between(0.0, 2.0 * pi);
        return t * (s * std::cos(phi)) + b * (s * std::sin(phi)) + n * c;
    }

private:
    std::mt19937_64 engine_;
};

} // namespace tessera::test
