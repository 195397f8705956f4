#pragma once
#include <vector>

#include "validation/reference/Hit.h"
#include "validation/reference/Textures.h"

namespace tessera::reference {

/// The least cosine between a lit normal and the viewer's direction, by the product's definition, before the bent one
/// is made unit, which takes 1.2e-4 of it. Where the triangle itself is seen as obliquely, half of its own cosine
/// counts.
inline constexpr double kLeastFacing = 1.0 / 64.0;

/// A unit normal whose cosine to the unit vector `toViewer` is less than `leastCosine`, with its part along that raised
/// to `leastCosine`, and unit again; any other as it is.
glm::dvec3 bentToViewer(const glm::dvec3& normal, const glm::dvec3& toViewer, double leastCosine);

/// The unit normal that is lit, world axes: interpolated from the vertices, replaced by the normal map's where the
/// material has one and its texel a direction, turned round on the back of a double-sided surface, and bent towards the
/// viewer, if there is one.
glm::dvec3 normalAt(const Hit& hit, const Textures& textures);

/// That of the coat: the mesh's, or its own normal map's, turned round and bent likewise.
glm::dvec3 coatNormalAt(const Hit& hit, const Textures& textures);

/// A direction in tangent space, as a unit vector at right angles to `normal`; some such vector where it has none.
glm::dvec3 tangentAt(const Hit& hit, const glm::dvec3& normal, const glm::dvec2& direction);

} // namespace tessera::reference
