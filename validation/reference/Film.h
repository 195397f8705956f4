#pragma once
#include <glm/glm.hpp>

namespace tessera::reference {

/// Reflectance of a thin film for light from outside, by channel, 0..1, on a surface that reflects `straight` without
/// it at normal incidence. `cosine` > 0 is that of the angle of incidence. Integrates over wavelengths. Source: Belcour
/// and Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence". The product's
/// definition takes the paper's fits of the eye's sensitivities, Schlick's factor at both interfaces, and four round
/// trips.
glm::dvec3 filmReflectance(const glm::dvec3& straight, double cosine, double ior, double thicknessNm);

} // namespace tessera::reference
