#pragma once
#include "validation/reference/MaterialAt.h"

namespace tessera::reference {

/// Reflectance of the metallic_roughness lobe towards the viewer under uniform illumination, by channel, before layers
/// above attenuate it: the integral of the BRDF's lobe, of dielectrics to 2e-4, of metals to 2e-3. A lobe of the least
/// alpha is a mirror. Zero where the normal points away from the viewer.
glm::dvec3 reflectedOfEvenLight(const SurfacePoint& point, const glm::dvec3& toViewer);

} // namespace tessera::reference
