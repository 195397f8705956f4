#pragma once
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Scene.h"

namespace tessera::frame {

/// Tangents by MikkTSpace, which glTF recommends and bakers use, one per mesh index: xyz unit and perpendicular to the
/// corner's normal, w the handedness. `textureFromUv` is the linear part of the texture's transform of the coordinates,
/// which have v downwards; tangents have it upwards.
///
/// Vertices of equal position, normal and coordinates are welded. Around a vertex, triangles that are connected by
/// edges and have the same handedness share a tangent: the mean of their directions of increasing u, projected into the
/// plane of the normal and weighted by the triangle's angle in that plane. A triangle without area in texture space or
/// in object space follows its neighbours. Corners without such neighbours get an arbitrary but stable frame; its w is
/// -1, as in Blender. Memory is linear in the mesh. Source: Mikkelsen 2008, "Simulation of Wrinkled Surfaces
/// Revisited", section 3.
std::vector<glm::vec4> mikkTSpaceTangents(const scenes::Mesh& mesh, std::size_t texCoordSet,
                                          const glm::dmat2& textureFromUv);

/// A unit vector perpendicular to n that does not jump between neighbouring normals, except near n = -z.
/// Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
glm::dvec3 anyPerpendicular(const glm::dvec3& n);

} // namespace tessera::frame
