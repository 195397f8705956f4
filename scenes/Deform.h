#pragma once
#include <span>
#include <vector>

#include "scenes/Animation.h"

namespace tessera::scenes {

/// Affine transforms of a shape's vertices into the space of the parent of the mesh's node.
struct VertexMatrices {
    std::span<const glm::dmat4x3> fromBind; ///< by joint of the skin
    glm::dmat4x3 ofOwn{1.0};                ///< of vertices without joints
};

/// Deforms a shape by morph targets, then by joints. Computes in double precision and rounds once. `mesh` has the
/// shape's sizes and keeps its name and indices. Without `matrices` vertices stay in the shape's space, and the
/// identity is returned. With them vertices are stored relative to their middle, mirrored if most of them are, and the
/// returned matrix maps them back. Entries of the result are not finite if a vertex is not.
glm::dmat4 deform(const Shape& shape, std::span<const double> weights, const VertexMatrices* matrices, Mesh& mesh);

} // namespace tessera::scenes
