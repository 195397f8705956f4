#include "scenes/Scene.h"

#include <algorithm>
#include <cassert>
#include <charconv>

namespace tessera::scenes {

std::size_t texelBytes(TexelFormat format) {
    switch (format) {
    case TexelFormat::Rgba8Unorm:
        return 4;
    case TexelFormat::Rgba16Unorm:
        return 8;
    case TexelFormat::Rgba32Float:
        return 16;
    }
    assert(false && "a texel format without a size");
    return 0;
}

std::optional<std::size_t> cameraCalled(const Scene& scene, std::string_view nameOrNumber) {
    const auto named = std::ranges::find(scene.cameras, nameOrNumber, &Camera::name);
    if (named != scene.cameras.end()) return std::size_t(named - scene.cameras.begin());
    std::size_t number = 0;
    const char* const end = nameOrNumber.data() + nameOrNumber.size();
    const auto [rest, error] = std::from_chars(nameOrNumber.data(), end, number);
    const bool isNumber = error == std::errc() && rest == end && number < scene.cameras.size();
    return isNumber ? std::optional(number) : std::nullopt;
}

std::vector<glm::dmat4> worldFromNodes(const Scene& scene) {
    std::vector<glm::dmat4> worldFromNode;
    worldFromNode.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes) {
        assert(node.parent < static_cast<int>(worldFromNode.size()) && "a parent stands before its children");
        worldFromNode.push_back(node.parent == kNone
                                    ? node.parentFromNode
                                    : worldFromNode[static_cast<std::size_t>(node.parent)] * node.parentFromNode);
    }
    return worldFromNode;
}

Box3 worldBounds(const Scene& scene) {
    const std::vector<glm::dmat4> worldFromNode = worldFromNodes(scene);
    Box3 boundsWS;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        for (const MeshInstance& instance : scene.nodes[n].instances) {
            // Vertices that no triangle uses are not drawn.
            const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
            for (const std::uint32_t index : mesh.indices) {
                boundsWS.extend(glm::dvec3(worldFromNode[n] * glm::dvec4(glm::dvec3(mesh.positionsOS[index]), 1.0)));
            }
        }
    }
    return boundsWS;
}

std::size_t triangleCount(const Scene& scene) {
    std::size_t triangles = 0;
    for (const Node& node : scene.nodes) {
        for (const MeshInstance& instance : node.instances) {
            triangles += scene.meshes[static_cast<std::size_t>(instance.mesh)].indices.size() / 3;
        }
    }
    return triangles;
}

std::set<std::size_t> hookedMeshes(const Scene& scene) {
    std::set<std::size_t> meshes;
    for (const Node& node : scene.nodes)
        for (const MeshInstance& instance : node.instances)
            if (scene.hook->changes(std::size_t(instance.material))) meshes.insert(std::size_t(instance.mesh));
    return meshes;
}

} // namespace tessera::scenes
