#pragma once
#include <array>
#include <cstdint>

/// Interpolation of curves between keys. Source: glTF 2.0 specification, appendix C.
namespace tessera::scenes {

enum class Interpolation : std::uint8_t {
    Linear, ///< rotations on the shortest great circle, at constant speed
    Step,   ///< each key's value until the next
    CubicSpline
};

/// Weights of a cubic spline for the key before, its out-tangent, the key after and its in-tangent, at fraction `share`
/// of the `seconds` between them. Tangents are per second.
constexpr std::array<double, 4> splineWeights(double share, double seconds) {
    const double s2 = share * share, s3 = s2 * share;
    return {2.0 * s3 - 3.0 * s2 + 1.0, seconds * (s3 - 2.0 * s2 + share), 3.0 * s2 - 2.0 * s3, seconds * (s3 - s2)};
}

/// Weights of the same four for the spline's derivative by `share`, with keys 1 s apart.
constexpr std::array<double, 4> splineSlopeWeights(double share) {
    const double s = share, s2 = share * share;
    return {6.0 * s2 - 6.0 * s, 3.0 * s2 - 4.0 * s + 1.0, 6.0 * s - 6.0 * s2, 3.0 * s2 - 2.0 * s};
}

} // namespace tessera::scenes
