#pragma once
#include <optional>

#include "scenes/Scene.h"

/// How bright a scene is as its camera sees it, estimated before anything is drawn.
namespace tessera::scenes {

/// Of a picture that is bright and leaves highlights room.
inline constexpr double kBrightLuminance = 0.4;

/// About the luminance, before exposure, that nine tenths of the surfaces stay below which a camera sees in a picture
/// of an aspect (width over height): of the mean of their textures, lit by the lights that are on, with nothing
/// before them. All are matte, or of metals the less counts, the smoother they are, and of glass what it does not let
/// through. Nothing
/// where none is seen. Takes some milliseconds, however many triangles and lights there are.
std::optional<double> estimatedLuminance(const Scene& scene, const Camera& camera, double aspect, bool areMatte = true);

/// Whole stops that bring such a luminance to kBrightLuminance; 0 where it is within two
/// stops of that, as in most pictures, or nothing is lit.
int fittingExposureEV(double luminance);

} // namespace tessera::scenes
