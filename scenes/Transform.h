#pragma once
#include <optional>

#include <glm/glm.hpp>

#include "scenes/Light.h"

namespace tessera::scenes {

/// translation * rotation * scale. `rotation` is a quaternion x, y, z, w, not zero.
glm::dmat4 transformOf(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale);

/// Cofactor matrix det(M) M^-T without a division, up to a positive factor: transforms normals and rotation axes.
glm::dmat3 cofactorOf(glm::dmat3 matrix);

/// Rigid transform of a camera at a node: it looks along the node's -Z, with +Y as close to the node's as possible, and
/// is never mirrored. If a scale of zero leaves no direction it looks along world -Z, and `isDegenerate` is set.
glm::dmat4 rigidOf(const glm::dmat4& worldFromNode, bool& isDegenerate);

/// Places a light at a node, shining along the node's -Z. False if a scale of zero leaves no direction; then it shines
/// along world -Z.
bool placeAtNode(Light& light, const glm::dmat4& worldFromNode);

} // namespace tessera::scenes
