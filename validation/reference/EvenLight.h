#pragma once
#include "validation/reference/MaterialAt.h"

namespace tessera::reference {

/// What the lobe of metallic_roughness reflects towards the viewer of light that is the same everywhere, by channel,
/// before what layers above leave of it: the integral of the BRDF's lobe, of dielectrics to 2e-4, of metals to 2e-3. A
/// lobe of the least alpha is a mirror, and nothing is reflected where the normal points away from the viewer.
glm::dvec3 reflectedOfEvenLight(const SurfacePoint& point, const glm::dvec3& toViewer);

} // namespace tessera::reference
