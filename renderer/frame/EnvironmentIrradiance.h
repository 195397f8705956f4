#pragma once
#include "renderer/frame/DividedOctahedron.h"
#include "scenes/Image.h"

/// Irradiance from an environment (docs/environment.md).
namespace tessera::frame {

/// The order that filterEnvironment() uses; tests compare others.
inline constexpr int kIrradianceOrder = 32;

/// Irradiance by surface normal, from spherical harmonics up to an order. Source: Ramamoorthi and Hanrahan 2001, "An
/// Efficient Representation for Irradiance Environment Maps".
DividedOctahedron irradianceOf(const scenes::Image& map, int order, int side);

} // namespace tessera::frame
