#pragma once
#include <glm/glm.hpp>

/// Factors of anisotropic and sheen lobes, in the form their sources print them. Vectors are in the frame of tangent,
/// bitangent and normal.
namespace tessera::reference {

/// GGX with alpha x along the tangent and alpha y along the bitangent, in 1/sr; 0 below the horizon.
/// Source: Burley 2012, "Physically-Based Shading at Disney", equation 13.
double distributionGgx(const glm::dvec2& alpha, const glm::dvec3& half);

/// The alpha along a direction's projection on the surface; along the normal the root mean square of both.
/// Source: Heitz 2014, section 5.3.
double alphaAlong(const glm::dvec2& alpha, const glm::dvec3& direction);

/// "Charlie", in 1/sr. Source: Conty Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF".
double distributionCharlie(double alpha, double cosNormalHalf);

/// G / (4 n.l n.v) by the same source. Both cosines are at least 1e-6, by the product's definition.
double visibilityCharlie(double alpha, double cosLight, double cosView);

/// The directional albedo of a white sheen, which scales the layers below it: the product's definition, a fit of the
/// integral.
double sheenAlbedo(double alpha, double cosine);

} // namespace tessera::reference
