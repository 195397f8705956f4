#pragma once
#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Scene.h"

namespace tessera::reference {

/// Tangents of a mesh from a set of its texture coordinates, object space, one a vertex: xyz unit, w the handedness.
/// Every triangle adds the directions in which u and v grow, unweighted, to its vertices; what is perpendicular to the
/// normal is kept. Where that is nothing, the frame is the one that Duff et al. 2017, "Building an Orthonormal Basis,
/// Revisited", build from the normal alone. v is taken upwards, against Scene's texture coordinates.
/// Source: Lengyel 2001, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh".
std::vector<glm::dvec4> tangentsOS(const scenes::Mesh& mesh, std::size_t texCoordSet);

} // namespace tessera::reference
