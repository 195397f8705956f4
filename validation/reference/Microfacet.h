#pragma once

/// Factors of microfacet models, in the form the papers print them. In double precision the cancellations that shaders
/// must avoid are harmless: 1 - cos^2 keeps ten digits of alpha^2 at the smallest alpha, 1e-3.
namespace tessera::reference {

/// GGX distribution of normals at the cosine between normal and half vector, in 1/sr; 0 below the horizon.
/// Source: Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", equation 33.
double distributionGgx(double alpha, double cosNormalHalf);

/// Smith's masking of one direction at its cosine with the normal, > 0. Source: Walter et al. 2007, equation 34.
double maskingSmith(double alpha, double cosNormal);

/// Height-correlated Smith masking and shadowing of two directions above the horizon.
/// Source: Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", equation 99.
double maskingCorrelated(double alpha, double cosNormalLight, double cosNormalView);

/// Reflectance of a smooth dielectric for unpolarised light at the cosine of incidence; ior is n2/n1. The mean of both
/// polarisations by Fresnel's equations with Snell's law; 1 beyond the critical angle.
double fresnelDielectric(double ior, double cosIncidence);

/// Schlick's approximation between the reflectances at normal (f0) and grazing (f90) incidence.
/// Source: Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering".
double fresnelSchlick(double f0, double f90, double cosIncidence);

} // namespace tessera::reference
