#pragma once
#include <string>

#include "scenes/Scene.h"

namespace tessera::validation {

/// Names the triangle that casts shadows, or the light, which spans most metres from the origin: rounding of shadow
/// rays grows with it. "triangle 12 of mesh 'wall' at node 'far', which reaches 1e+06 m from the origin"; empty where
/// there is neither.
std::string longestSpan(const scenes::Scene& scene);

} // namespace tessera::validation
