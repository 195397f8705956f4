#pragma once
#include "viewer/camera/CameraPose.h"

namespace tessera::viewer {

/// A white point light for what a camera sees: halfway to the surface in the picture's middle, or to the focus where
/// nothing is. On the surface nearest to it, a grey one has this luminance, before exposure; its range is a few times
/// that surface's distance. Throws std::runtime_error when memory runs out.
scenes::Light lightBefore(const scenes::Scene& scene, const CameraPose& pose, double luminance);

/// The luminance that makes such a light noticed, and burns nothing: about twice the mean of the picture, both as a
/// display of an exposure shows them.
double noticedLuminance(double meanLuminance, double exposureEV);

} // namespace tessera::viewer
