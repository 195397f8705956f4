#pragma once
#include <optional>

#include "scenes/Scene.h"

/// How bright a scene is as its camera sees it, estimated before anything is drawn.
namespace tessera::scenes {

/// About the mean luminance, before exposure, of the surfaces that a camera sees in a picture of an aspect (width over
/// height): matte, of the mean of their textures, lit by the lights that are on, with nothing before them. Nothing
/// where none is seen. Takes some milliseconds, however many triangles and lights there are.
std::optional<double> estimatedLuminance(const Scene& scene, const Camera& camera, double aspect);

/// Whole stops that bring surfaces of such a luminance to middle grey, 0.18; 0 where they are within two stops of it,
/// as any picture's are, or black.
int fittingExposureEV(double luminance);

} // namespace tessera::scenes
