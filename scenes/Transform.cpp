#include "scenes/Transform.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/quaternion.hpp>

namespace tessera::scenes {
namespace {

/// Scales the axis by a power of two, so that its largest component is from 1 to 2: nested scales can make squares
/// overflow. Zero stays zero.
glm::dvec3 aboutOne(const glm::dvec4& axis) {
    const glm::dvec3 size = glm::abs(glm::dvec3(axis));
    const double largest = std::max({size.x, size.y, size.z});
    if (largest == 0.0) return glm::dvec3(0.0);
    const int exponent = std::ilogb(largest);
    return {std::scalbn(axis.x, -exponent), std::scalbn(axis.y, -exponent), std::scalbn(axis.z, -exponent)};
}

} // namespace

glm::dmat4 transformOf(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale) {
    const glm::dquat quaternion(rotation.w, rotation.x, rotation.y, rotation.z); // glm takes w first
    const glm::dmat3 turned = glm::mat3_cast(glm::normalize(quaternion));
    glm::dmat4 parentFromNode(1.0);
    for (int column = 0; column < 3; ++column) parentFromNode[column] = glm::dvec4(turned[column] * scale[column], 0.0);
    parentFromNode[3] = glm::dvec4(translation, 1.0);
    return parentFromNode;
}

glm::dmat3 cofactorOf(glm::dmat3 matrix) {
    // Scaled, so that products of its entries neither overflow nor underflow.
    double largest = 0.0;
    for (glm::length_t i = 0; i < 9; ++i) largest = std::max(largest, std::abs(matrix[i / 3][i % 3]));
    if (largest > 0.0) matrix /= largest;
    return {glm::cross(matrix[1], matrix[2]), glm::cross(matrix[2], matrix[0]), glm::cross(matrix[0], matrix[1])};
}

glm::dmat4 rigidOf(const glm::dmat4& worldFromNode, bool& isDegenerate) {
    const glm::dvec3 upWS = aboutOne(worldFromNode[1]), backWS = aboutOne(worldFromNode[2]);
    const glm::dvec3 rightWS = glm::cross(upWS, backWS);
    // 1e-12 is far above double's rounding.
    isDegenerate = !(glm::length(rightWS) > 1e-12 * glm::length(backWS) * glm::length(upWS));
    glm::dmat4 rigid(1.0);
    if (!isDegenerate) {
        rigid[2] = glm::dvec4(glm::normalize(backWS), 0.0);
        rigid[0] = glm::dvec4(glm::normalize(rightWS), 0.0);
        rigid[1] = glm::dvec4(glm::cross(glm::dvec3(rigid[2]), glm::dvec3(rigid[0])), 0.0);
    }
    rigid[3] = worldFromNode[3];
    return rigid;
}

bool placeAtNode(Light& light, const glm::dmat4& worldFromNode) {
    light.positionWS = glm::dvec3(worldFromNode[3]);
    const glm::dvec3 backwardsWS = aboutOne(worldFromNode[2]);
    const bool hasDirection = backwardsWS != glm::dvec3(0.0);
    light.directionWS = hasDirection ? -backwardsWS / glm::length(backwardsWS) : glm::dvec3(0.0, 0.0, -1.0);
    return hasDirection;
}

} // namespace tessera::scenes
