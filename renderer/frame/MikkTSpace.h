#pragma once
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Scene.h"

namespace tessera::frame {

/// Tangents by MikkTSpace, which glTF recommends and bakers use, one for each of a mesh's indices: xyz unit and
/// perpendicular to the corner's normal, w the handedness. `textureFromUv` is the linear part of what the texture does
/// to the coordinates of the set, which have v downwards; tangents have it upwards.
///
/// Vertices of equal position, normal and coordinates are one. Around a vertex, triangles that hang together by edges
/// and are not mirrored against each other share a tangent: the mean of the directions in which u grows on each, laid
/// into the plane of the normal, weighted by the triangle's angle in that plane. A triangle without area in texture
/// space follows its neighbours, and so does one without area in space. Corners without such neighbours get a frame
/// that is arbitrary but stable; its w is -1, as Blender's is. Takes memory linear in the
/// mesh. Source: Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited", section 3.
std::vector<glm::vec4> mikkTSpaceTangents(const scenes::Mesh& mesh, std::size_t texCoordSet,
                                          const glm::dmat2& textureFromUv);

/// A unit vector perpendicular to n that does not jump between neighbouring normals, except near n = -z.
/// Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
glm::dvec3 anyPerpendicular(const glm::dvec3& n);

} // namespace tessera::frame
