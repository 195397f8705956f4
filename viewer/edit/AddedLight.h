#pragma once
#include "viewer/camera/CameraPose.h"

namespace tessera::viewer {

/// A white point light for a camera's view: halfway to the surface at the image centre, or to the focus if there is
/// none. It gives a grey surface, at the distance of the nearest one, this luminance before exposure; its range is a
/// few times that distance. Throws std::runtime_error when memory runs out.
scenes::Light lightBefore(const scenes::Scene& scene, const CameraPose& pose, double luminance);

/// The luminance that makes such a light noticeable without overexposure: about twice the mean of the image, both as
/// displayed with an exposure.
double noticedLuminance(double meanLuminance, double exposureEV);

} // namespace tessera::viewer
