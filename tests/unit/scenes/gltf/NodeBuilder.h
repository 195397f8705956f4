#pragma once
#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "GltfBuilder.h"

namespace tessera::scenes::gltf::test {

/// Rounding of a few double operations on numbers near 1.
inline constexpr double kNodeRounding = 1e-14;

inline void expectNear(const glm::dvec3& value, const glm::dvec3& expected) {
    EXPECT_LT(glm::length(value - expected), kNodeRounding) << value.x << ' ' << value.y << ' ' << value.z;
}

inline Builder withNodes(const char* nodes, const char* roots = "[0]") {
    Builder builder;
    builder.json["nodes"] = Json::parse(nodes);
    builder.json["scenes"][0]["nodes"] = Json::parse(roots);
    return builder;
}

} // namespace tessera::scenes::gltf::test
