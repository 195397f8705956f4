#pragma once
#include "validation/reference/LightAt.h"
#include "validation/reference/Sampling.h"

/// Unshadowed light of area lights: integrals over the directions in which they are visible from a point, by adaptive
/// cubature in double precision. The unit square of each patch (SeenArea.h) is first quartered until no lobe turns much
/// within a square, so that none is missed, and a square holds few texels of the light's image; this takes at most half
/// of the squares. Squares where two rules differ most are then quartered, until all differences together are
/// Settings::areaTolerance of the integral or there are Settings::areaSquares squares. The better rule is nearer to the
/// integral than the two are to each other.
namespace tessera::reference {

/// Radiance reflected by a surface; `onlyLobes` leaves out light that enters the surface. The standard error is the sum
/// of the differences of the rules.
Estimate reflectedOf(const ShiningLight& light, const SurfacePoint& point, const glm::dvec3& positionRWS,
                     const glm::dvec3& toViewer, bool specular, bool onlyLobes, const Settings& settings);

/// Irradiance of a surface with this normal.
glm::dvec3 irradianceOf(const ShiningLight& light, const glm::dvec3& positionRWS, const glm::dvec3& normal,
                        const Settings& settings);

} // namespace tessera::reference
