#pragma once
#include <string>

#include "scenes/Scene.h"

namespace tessera::validation {

/// Names the shadow-casting triangle or the light that extends farthest from the origin, since rounding of shadow rays
/// grows with the distance: "triangle 12 of mesh 'wall' at node 'far', which reaches 1e+06 m from the origin"; empty if
/// there is neither.
std::string longestSpan(const scenes::Scene& scene);

} // namespace tessera::validation
