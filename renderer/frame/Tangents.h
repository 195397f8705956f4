#pragma once
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Scene.h"

namespace tessera::frame {

/// Tangents from texture coordinates: each vertex sums the directions in which u and v grow over its triangles, then
/// the tangent is made perpendicular to the normal; w is the handedness, so mirrored coordinates keep their sense.
/// Vertices whose triangles have no area in texture space get an arbitrary but stable frame. xyz unit, w +1 or -1, one
/// a vertex. Source: Lengyel 2001, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh".
std::vector<glm::vec4> computeTangents(const scenes::Mesh& mesh, std::size_t texCoordSet);

} // namespace tessera::frame
