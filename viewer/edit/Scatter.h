#pragma once
#include <cstdint>
#include <functional>

#include "scenes/Scene.h"

namespace tessera::viewer {

inline constexpr int kMostScattered = 65536;

struct Scatter {
    int count = 1024; ///< 0 to kMostScattered
    std::uint64_t seed = 1;
    double lightsPerPoint = 8.0; ///< mean number that reaches a surface point; determines their range
    double lux = 0.5;            ///< mean illuminance of surfaces; less if it would overexpose a twentieth of them
};

/// Point lights in front of the floors, walls and ceilings of a scene and inside its bounds, with equal density on all
/// surfaces, identical for the same seed on every machine. Colours are those of lamps, with equal luminance; ranges
/// vary about a mean that follows from the density, as do intensities, so that more lights neither brighten the image
/// nor cost more per pixel. An empty scene gets them in a cube of 2 m about the origin. Names count from "scattered 0".
std::vector<scenes::Light> scatterLights(const scenes::Scene& scene, const Scatter& scatter);

/// Colour temperatures of scattered lights: nearly a candle's flame to daylight.
inline constexpr double kWarmestKelvin = 2200.0, kCoolestKelvin = 6500.0;

/// Linear colour of luminance 1 of a black body of 1667 to 25000 K. Source: Kim et al. 2002, cubic splines of the
/// Planckian locus; ITU-R BT.709.
glm::vec3 lampColor(double kelvin);

} // namespace tessera::viewer
