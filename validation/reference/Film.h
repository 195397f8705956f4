#pragma once
#include <glm/glm.hpp>

namespace tessera::reference {

/// What a thin film reflects of light from outside, by channel, 0..1, on a surface that reflects `straight` without it
/// at normal incidence. `cosine` > 0 is that of the angle of incidence. Integrates over wavelengths what a film
/// reflects of each. Source: Belcour and Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of
/// Varying Iridescence", whose fits of the eye's sensitivities and Schlick's factor at both sides are the product's
/// definition, and so are four ways back and forth.
glm::dvec3 filmReflectance(const glm::dvec3& straight, double cosine, double ior, double thicknessNm);

} // namespace tessera::reference
