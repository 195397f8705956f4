#pragma once
#include <span>
#include <vector>

#include "scenes/Animation.h"

namespace tessera::scenes {

/// What moves the vertices of a shape, affine, into the space of the node that its mesh stands below.
struct VertexMatrices {
    std::span<const glm::dmat4x3> fromBind; ///< by joint of the skin
    glm::dmat4x3 ofOwn{1.0};                ///< of vertices that follow no joint
};

/// Deforms a shape: morph targets by their weights, then joints by theirs. Computes in double precision and rounds
/// once. `mesh` is of the shape's lengths and keeps its name and indices. Without `matrices` its vertices stay in the
/// shape's own space, and the identity is returned; with them they are stored around their middle, mirrored where most
/// of them are, and what is returned brings them back. Entries of the result are not finite where a vertex is not.
glm::dmat4 deform(const Shape& shape, std::span<const double> weights, const VertexMatrices* matrices, Mesh& mesh);

} // namespace tessera::scenes
