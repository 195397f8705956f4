#pragma once
#include <vector>

#include "validation/reference/Hit.h"
#include "validation/reference/Textures.h"

namespace tessera::reference {

/// The least cosine between a shading normal and the viewer's direction, by the product's definition, before the bent
/// normal is normalised, which takes 1.2e-4 of it. At grazing views it is at most half of the triangle's own cosine.
inline constexpr double kLeastFacing = 1.0 / 64.0;

/// Bends a unit normal whose cosine to the unit vector `toViewer` is less than `leastCosine`: raises its component
/// along `toViewer` to `leastCosine`, and normalises it. Returns any other normal unchanged.
glm::dvec3 bentToViewer(const glm::dvec3& normal, const glm::dvec3& toViewer, double leastCosine);

/// The unit shading normal, world axes: interpolated from the vertices, replaced by the normal map's where the material
/// has one and its texel a direction, flipped on the back of a double-sided surface, and bent towards the viewer, if
/// there is one.
glm::dvec3 normalAt(const Hit& hit, const Textures& textures);

/// The coat's shading normal: the mesh's, or its own normal map's, flipped and bent likewise.
glm::dvec3 coatNormalAt(const Hit& hit, const Textures& textures);

/// A direction of tangent space as a unit vector perpendicular to `normal`; an arbitrary such vector if it has none.
glm::dvec3 tangentAt(const Hit& hit, const glm::dvec3& normal, const glm::dvec2& direction);

} // namespace tessera::reference
