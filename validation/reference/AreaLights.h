#pragma once
#include "validation/reference/LightAt.h"
#include "validation/reference/Sampling.h"

/// Light of area lights that nothing hides: integrals over the directions in which a point sees them, by adaptive
/// cubature in double precision. The unit square of each patch (SeenArea.h) is first quartered until no lobe turns much
/// within a square, so that none is missed, and it holds a few texels of the light's picture, as long as half of the
/// squares are left; then where two rules differ most, until all differences together are
/// Settings::areaTolerance of the integral or there are Settings::areaSquares squares. The better rule is nearer to the
/// integral than the two are to each other.
namespace tessera::reference {

/// What a surface reflects; `onlyLobes` leaves out what enters the surface. The standard error is the sum of the
/// differences.
Estimate reflectedOf(const ShiningLight& light, const SurfacePoint& point, const glm::dvec3& positionRWS,
                     const glm::dvec3& toViewer, bool specular, bool onlyLobes, const Settings& settings);

/// On a surface that faces this way.
glm::dvec3 irradianceOf(const ShiningLight& light, const glm::dvec3& positionRWS, const glm::dvec3& normal,
                        const Settings& settings);

} // namespace tessera::reference
