#pragma once
#include <optional>

#include "scenes/Scene.h"

/// Estimates the luminance of a camera's view before anything is rendered.
namespace tessera::scenes {

/// Luminance of a bright image with headroom for highlights.
inline constexpr double kBrightLuminance = 0.4;

/// Estimates the 90th percentile of the luminance of visible surfaces, by image area and before exposure, for a camera
/// and an aspect (width over height). Surfaces have the mean of their textures and are lit by the enabled lights
/// without occlusion. All are matte, or if not `areMatte`, smooth metals count less than rough ones, and glass by its
/// untransmitted part. Nothing if no surface is visible. Takes some milliseconds, however many triangles and lights
/// there are.
std::optional<double> estimatedLuminance(const Scene& scene, const Camera& camera, double aspect, bool areMatte = true);

/// Whole stops that bring an estimated luminance to kBrightLuminance; 0 if it is within two stops of that, as in most
/// images, or not lit.
int fittingExposureEV(double luminance);

} // namespace tessera::scenes
