#pragma once
#include "renderer/frame/PackedLights.h"

namespace tessera::validation {

/// Lights for the surface that measures the lower bound (shaders/bench/bound_surface.glsl): `count` lights within a
/// metre of the eye, each of which reaches every point of the surface and lies in front of it. They are of the kinds of
/// the given packed lights, in about the same shares; point lights where there are none.
frame::PackedLights lowerBoundLights(const frame::PackedLights& like, int count);

} // namespace tessera::validation
