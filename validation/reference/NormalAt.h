#pragma once
#include <vector>

#include "validation/reference/Hit.h"

namespace tessera::reference {

/// The unit normal that is lit, world axes: interpolated from the vertices, replaced by the normal map's where the
/// material has one and its texel a direction, and turned round on the back of a double-sided surface.
glm::dvec3 normalAt(const Hit& hit, const std::vector<scenes::Image>& images);

} // namespace tessera::reference
