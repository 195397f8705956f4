#pragma once
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Scene.h"

namespace tessera::reference {

/// Tangents of a mesh as a material wants them that needs some (TangentFrame.h), object space, one for each of the
/// mesh's indices: xyz unit, w the handedness. The mesh's own are turned and mirrored as the texture is; else they are
/// derived from the texture's transformed coordinates, with v upwards, against Scene's.
///
/// mikktspace: from each corner the reference walks round its vertex to both sides, from triangle to triangle across
/// shared edges, up to an open edge or a triangle whose texture is mirrored against the first one's. Vertices are one
/// where position, normal and coordinates are. The tangent is the mean of the walked triangles' directions of u, each
/// made unit in the plane of the normal, by their angles there. Triangles whose texture has no area are walked through
/// and counted to the first walk that comes by; those with two corners at one point take what the first other triangle
/// has at their vertices. What no walk has reached gets Duff's frame and -1.
/// Source: Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited".
///
/// lengyel: every triangle adds the directions in which u and v grow, unweighted, to its vertices; what is
/// perpendicular to the normal is kept. Where that is nothing, the frame is Duff's and 1. Source: Lengyel 2001,
/// "Computing Tangent Space Basis Vectors for an Arbitrary Mesh".
///
/// Duff's frame is the one that Duff et al. 2017, "Building an Orthonormal Basis, Revisited", build from a normal.
std::vector<glm::dvec4> tangentsOS(const scenes::Mesh& mesh, const scenes::Material& material);

} // namespace tessera::reference
