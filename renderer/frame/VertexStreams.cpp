#include "renderer/frame/VertexStreams.h"

#include "renderer/frame/Tangents.h"

namespace tessera::frame {

namespace {

/// Appends a mesh's attribute, or `count` neutral values where the mesh has none.
template <typename T>
void append(std::vector<T>& stream, const std::vector<T>& values, std::size_t count, const T& neutral) {
    if (values.empty()) {
        stream.resize(stream.size() + count, neutral);
    } else {
        stream.insert(stream.end(), values.begin(), values.end());
    }
}

/// The texture-coordinate set of the tangent-space normal map that a mesh is drawn with, or -1 without one. A mesh
/// drawn with two such maps on different sets follows the first.
std::vector<int> normalMapSets(const scenes::Scene& scene) {
    std::vector<int> sets(scene.meshes.size(), -1);
    for (const scenes::Node& node : scene.nodes) {
        for (const scenes::MeshInstance& instance : node.instances) {
            const scenes::Material& material = scene.materials[std::size_t(instance.material)];
            const scenes::TextureUse& use = material.texture(scenes::TextureSlot::Normal);
            if (use.image == scenes::kNone || material.normalMapSpace == scenes::NormalMapSpace::Object) continue;
            int& set = sets[std::size_t(instance.mesh)];
            if (set < 0) set = use.texCoordSet;
        }
    }
    return sets;
}

} // namespace

VertexStreams makeVertexStreams(const scenes::Scene& scene, const FeatureSet& features) {
    VertexStreams streams;
    const std::vector<int> tangentSets = normalMapSets(scene);
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const scenes::Mesh& mesh = scene.meshes[i];
        const std::size_t count = mesh.positionsOS.size();
        streams.ranges.push_back({std::uint32_t(streams.indices.size()), std::uint32_t(mesh.indices.size()),
                                  std::int32_t(streams.positionsOS.size())});
        streams.indices.insert(streams.indices.end(), mesh.indices.begin(), mesh.indices.end());
        append(streams.positionsOS, mesh.positionsOS, count, glm::vec3(0.0f));
        append(streams.normalsOS, mesh.normalsOS, count, glm::vec3(0.0f));
        if (features[Feature::TangentSpaceNormals]) {
            const bool computed = mesh.tangentsOS.empty() && tangentSets[i] >= 0;
            append(streams.tangentsOS, computed ? computeTangents(mesh, std::size_t(tangentSets[i])) : mesh.tangentsOS,
                   count, glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));
        }
        if (features.textures()) append(streams.texCoords[0], mesh.texCoords[0], count, glm::vec2(0.0f));
        if (features[Feature::TexCoord1]) append(streams.texCoords[1], mesh.texCoords[1], count, glm::vec2(0.0f));
        if (features[Feature::VertexColor]) append(streams.colors, mesh.colors, count, glm::vec4(1.0f));
    }
    return streams;
}

} // namespace tessera::frame
