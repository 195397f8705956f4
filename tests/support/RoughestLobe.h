#pragma once
#include <cmath>
#include <numbers>

/// The GGX lobe of alpha 1 and reflectance 1 in closed form. D is 1 / pi for every half vector, and height-correlated
/// masking leaves D G / (4 c mu) = 1 / (2 pi (c + mu)) at cosines c of the light and mu of the viewer (Heitz 2014).
/// Times the cosine of the light this is c / (2 pi (c + mu)), which is not a cosine lobe.
namespace tessera::test {

/// Radiance reflected under uniform illumination of radiance 1.
inline double roughestAlbedo(double cosView) {
    return 1.0 - cosView * std::log(1.0 + 1.0 / cosView);
}

/// The same for light from a cap of this half angle, centred at an angle of `axisRadians` from the normal. The cap must
/// be above the horizon, and contain the normal only at its centre.
inline double roughestShareOfCap(double cosView, double axisRadians, double halfAngleRadians) {
    using std::numbers::pi;
    const double cosHalf = std::cos(halfAngleRadians);
    if (axisRadians == 0.0) // the integral of c / (c + mu) from the cap's edge to its centre
        return 1.0 - cosHalf - cosView * std::log((1.0 + cosView) / (cosHalf + cosView));
    // Integrates over circles around the normal by their arcs in the cap; denser at both ends, where the arcs vanish.
    constexpr int kCircles = 8000; // error below 1e-7
    double sum = 0.0;
    for (int i = 0; i < kCircles; ++i) {
        const double place = pi * ((i + 0.5) / kCircles - 0.5);
        const double angle = axisRadians + halfAngleRadians * std::sin(place), cosine = std::cos(angle);
        const double arc =
            2.0 * std::acos((cosHalf - cosine * std::cos(axisRadians)) / (std::sin(angle) * std::sin(axisRadians)));
        sum += cosine / (cosine + cosView) * arc / (2.0 * pi) * std::sin(angle) * halfAngleRadians * std::cos(place);
    }
    return sum * pi / kCircles;
}

} // namespace tessera::test
