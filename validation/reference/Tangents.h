#pragma once
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Scene.h"

namespace tessera::reference {

/// Object-space tangents of a mesh for a material that needs them (TangentFrame.h), one per index of the mesh: xyz
/// unit, w the handedness. The mesh's own tangents are rotated and mirrored as the texture is. Without any they are
/// derived from the texture's transformed coordinates, with v upwards, against Scene's.
///
/// mikktspace: from each corner the reference walks round its vertex to both sides, from triangle to triangle across
/// shared edges, up to an open edge or a triangle whose texture is mirrored against the first one's. Vertices are
/// merged where position, normal and coordinates are equal. The tangent is the mean of the walked triangles' directions
/// of u, each normalised in the plane of the normal, weighted by their angles there. Triangles whose texture has no
/// area are walked through and belong to the first walk that reaches them. Those with two corners at one point take the
/// tangents of the first other triangle at their vertices. Corners that no walk reaches get Duff's frame and -1.
/// Source: Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited".
///
/// lengyel: every triangle adds the directions in which u and v grow, unweighted, to its vertices. The part
/// perpendicular to the normal is kept; where it is zero, the frame is Duff's and 1. Source: Lengyel 2001, "Computing
/// Tangent Space Basis Vectors for an Arbitrary Mesh".
///
/// Duff's frame is built from a normal by Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
std::vector<glm::dvec4> tangentsOS(const scenes::Mesh& mesh, const scenes::Material& material);

} // namespace tessera::reference
