#pragma once
#include "renderer/frame/PackedLights.h"

namespace tessera::validation {

/// Lights for the surface that measures the lower bound (shaders/bench/bound_surface.glsl): `count` lights within a
/// metre of the eye, all in front of every point of the surface and in range. Their types are those of the given packed
/// lights, in about the same proportions; point lights if there are none.
frame::PackedLights lowerBoundLights(const frame::PackedLights& like, int count);

} // namespace tessera::validation
