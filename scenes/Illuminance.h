#pragma once
#include <glm/glm.hpp>

#include "scenes/Light.h"

/// How brightly lights shine, for estimates: lighting itself is the shaders', and the reference's.
namespace tessera::scenes {

/// Luminance of linear Rec. 709 light, or luminous factor of a colour. Source: ITU-R BT.709.
double luminanceOf(const glm::dvec3& color);

/// About the illuminance in lux of what faces the light, in its range and cone; of lights that fall off by A, B and C
/// in their own unit. A light with an area counts as a point that is as bright as its largest side.
double illuminanceAt(const Light& light, const glm::dvec3& positionWS);

} // namespace tessera::scenes
