#pragma once
#include <optional>

#include "scenes/Scene.h"

/// How bright a scene is as its camera sees it, estimated before anything is drawn.
namespace tessera::scenes {

/// About the luminance, before exposure, that nine tenths of the surfaces stay below which a camera sees in a picture
/// of an aspect (width over height): matte, of the mean of their textures, lit by the lights that are on, with nothing
/// before them. Nothing where none is seen. Takes some milliseconds, however many triangles and lights there are.
std::optional<double> estimatedLuminance(const Scene& scene, const Camera& camera, double aspect);

/// Whole stops that bring such a luminance to 0.4, which is bright and leaves highlights room; 0 where it is within two
/// stops of that, as in most pictures, or nothing is lit.
int fittingExposureEV(double luminance);

} // namespace tessera::scenes
