#pragma once
#include <glm/glm.hpp>

#include "scenes/Light.h"

/// Approximate illuminance by lights, for estimates only; shaders and the reference compute the lighting.
namespace tessera::scenes {

/// Luminance of linear Rec. 709 light or of a colour factor. Source: ITU-R BT.709.
double luminanceOf(const glm::dvec3& color);

/// Approximate illuminance in lux of a surface that faces the light, within its range and cone; lights with A, B and C
/// attenuation use their own unit. An area light counts as a point light with its largest projected area.
double illuminanceAt(const Light& light, const glm::dvec3& positionWS);

} // namespace tessera::scenes
