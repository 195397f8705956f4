#pragma once
#include <cstdint>
#include <functional>

#include "scenes/Scene.h"

namespace tessera::viewer {

inline constexpr int kMostScattered = 65536;

struct Scatter {
    int count = 1024; ///< 0 to kMostScattered
    std::uint64_t seed = 1;
    double lightsPerPoint = 8.0; ///< that reach a point of a surface, on average; decides their range
    double lux = 0.5;            ///< mean illuminance of surfaces; less where it would burn a twentieth of them
};

/// Point lights before the floors, walls and ceilings of a scene and inside its bounds, as dense on one surface as on
/// another, the same for the same seed on every machine. Colours are those of lamps and of one luminance; ranges differ
/// about one that follows from the density, as intensities do, so that more lights make neither the picture nor a
/// pixel's work larger. A scene of nothing has them in a cube of 2 m about the origin. Names count from "scattered 0".
std::vector<scenes::Light> scatterLights(const scenes::Scene& scene, const Scatter& scatter);

/// Colour temperatures of scattered lights: of a candle's flame, nearly, to daylight.
inline constexpr double kWarmestKelvin = 2200.0, kCoolestKelvin = 6500.0;

/// Linear colour of luminance 1 of a black body of 1667 to 25000 K. Source: Kim et al. 2002, cubic splines of the
/// Planckian locus; ITU-R BT.709.
glm::vec3 lampColor(double kelvin);

} // namespace tessera::viewer
