#pragma once
#include <optional>

#include <glm/glm.hpp>

#include "scenes/Light.h"

namespace tessera::scenes {

/// translation * rotation * scale. `rotation` is x, y, z, w of a quaternion that is not zero.
glm::dmat4 transformOf(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale);

/// det(M) M^-T without a division, up to a positive factor: what normals and axes of rotation are moved by.
glm::dmat3 cofactorOf(glm::dmat3 matrix);

/// Where a camera at a node stands: it looks where the transform sends -Z, with its +Y as upright as can be, and never
/// mirrored. Along -Z where a scale of zero leaves no direction, and then `isDegenerate`.
glm::dmat4 rigidOf(const glm::dmat4& worldFromNode, bool& isDegenerate);

/// Puts a light where a node is, shining along its -Z. False where a scale of zero leaves no direction; then it keeps
/// -Z.
bool placeAtNode(Light& light, const glm::dmat4& worldFromNode);

} // namespace tessera::scenes
