#pragma once
#include "renderer/frame/DividedOctahedron.h"
#include "scenes/Image.h"

/// What falls of an environment on a surface (docs/environment.md).
namespace tessera::frame {

/// What filterEnvironment() takes; tests compare others.
inline constexpr int kIrradianceOrder = 32;

/// Irradiance on a surface that faces each direction, by spherical harmonics up to an order. Source: Ramamoorthi and
/// Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps".
DividedOctahedron irradianceOf(const scenes::Image& map, int order, int side);

} // namespace tessera::frame
