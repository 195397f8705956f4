#pragma once
#include <vector>

#include "validation/reference/Hit.h"
#include "validation/reference/Textures.h"

namespace tessera::reference {

/// The unit normal that is lit, world axes: interpolated from the vertices, replaced by the normal map's where the
/// material has one and its texel a direction, and turned round on the back of a double-sided surface.
glm::dvec3 normalAt(const Hit& hit, const Textures& textures);

/// That of the coat: the mesh's, or its own normal map's, turned round likewise.
glm::dvec3 coatNormalAt(const Hit& hit, const Textures& textures);

/// A direction in tangent space, as a unit vector at right angles to `normal`; some such vector where it has none.
glm::dvec3 tangentAt(const Hit& hit, const glm::dvec3& normal, const glm::dvec2& direction);

} // namespace tessera::reference
