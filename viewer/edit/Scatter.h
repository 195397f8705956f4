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
    double lux = 3.0;            ///< mean illuminance of all of them on surfaces
};

/// Point lights above the surfaces of a scene and inside its bounds, as dense on one surface as on another, the same
/// for the same seed on every machine. Colours differ in hue and are of one luminance; range and intensity follow from
/// the density, so that more lights make neither the picture nor a pixel's work larger. A scene of nothing has them in
/// a cube of 2 m about the origin. Names count from "scattered 0".
std::vector<scenes::Light> scatterLights(const scenes::Scene& scene, const Scatter& scatter);

/// A saturated colour of a hue (0 to 1, red to red), mixed with white so that even blue needs no extreme channel, of
/// luminance 1. Source of the weights: ITU-R BT.709.
glm::vec3 equalLuminanceColor(double hue);

} // namespace tessera::viewer
