#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "scenes/Pose.h"
#include "tests/unit/scenes/gltf/GltfBuilder.h"

/// glTF documents with clips for the importer's tests, and their poses at a time.
namespace tessera::scenes::gltf::test {

inline constexpr int kFloatType = 5126, kShortType = 5122, kUnsignedByteType = 5121, kUnsignedShortType = 5123;
inline constexpr float kHalfRoot = 0.70710678f; ///< half of the square root of 2

/// Adds a clip with one channel.
inline void addClip(Builder& builder, const std::vector<float>& times, int output, Json target,
                    const char* interpolation = "LINEAR", const char* name = "clip") {
    const int input = builder.add("SCALAR", times);
    builder.json["animations"].push_back(
        {{"name", name},
         {"samplers", Json::array({{{"input", input}, {"output", output}, {"interpolation", interpolation}}})},
         {"channels", Json::array({{{"sampler", 0}, {"target", std::move(target)}}})}});
}

/// Adds a clip of a node's "translation", "rotation", "scale" or "weights", with one value per time.
template <typename T = float>
void animate(Builder& builder, int node, const char* path, const char* type, const std::vector<T>& values,
             bool isNormalized = false, const char* interpolation = "LINEAR",
             const std::vector<float>& times = {0, 1}) {
    const int output = builder.add(type, values, isNormalized);
    addClip(builder, times, output, {{"node", node}, {"path", path}}, interpolation);
}

/// A channel target of KHR_animation_pointer.
inline Json pointerTo(const std::string& pointer) {
    return {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
}

/// Adds a clip of a pointer's property: the first half of `values` at 0 s, the second at 1 s.
inline void addPointer(Builder& builder, const std::string& pointer, const std::vector<float>& values) {
    constexpr const char* kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    const int output = builder.add(kTypes[values.size() / 2 - 1], values);
    addClip(builder, {0, 1}, output, pointerTo(pointer));
}

/// A triangle that moves 2 along x within a second.
inline Builder movingTriangle() {
    Builder builder;
    animate(builder, 0, "translation", "VEC3", {0, 0, 0, 2, 0, 0});
    return builder;
}

/// World positions of the drawn vertices at a time.
inline std::vector<glm::dvec3> drawnAt(Scene scene, double timeSeconds) {
    checkScene(scene);
    poseScene(scene, timeSeconds);
    checkScene(scene);
    const std::vector<glm::dmat4> worldFromNode = worldFromNodes(scene);
    std::vector<glm::dvec3> places;
    for (std::size_t node = 0; node < scene.nodes.size(); ++node)
        for (const MeshInstance& instance : scene.nodes[node].instances)
            for (const glm::vec3& positionOS : scene.meshes[std::size_t(instance.mesh)].positionsOS)
                places.emplace_back(worldFromNode[node] * glm::dvec4(positionOS, 1.0));
    return places;
}

inline void expectPlace(const glm::dvec3& found, const glm::dvec3& wanted) {
    EXPECT_NEAR(found.x, wanted.x, 1e-6);
    EXPECT_NEAR(found.y, wanted.y, 1e-6);
    EXPECT_NEAR(found.z, wanted.z, 1e-6);
}

} // namespace tessera::scenes::gltf::test
