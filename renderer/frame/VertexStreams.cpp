#include "renderer/frame/VertexStreams.h"

#include "renderer/frame/Tangents.h"
#include "scenes/InUse.h"

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

/// The texture-coordinate set that the material's tangents follow, or -1 where it needs none: that of its tangent-space
/// normal map, else of what else is given in tangent space.
int tangentSet(const scenes::Material& material) {
    using scenes::TextureSlot;
    const scenes::TextureUse& normal = material.texture(TextureSlot::Normal);
    if (normal.image != scenes::kNone && material.normalMapSpace == scenes::NormalMapSpace::Tangent)
        return normal.texCoordSet;
    const bool metallicRoughness = material.model == scenes::MaterialModel::MetallicRoughness;
    const bool anisotropic = material.model == scenes::MaterialModel::MicrofacetAnisotropic ||
                             (metallicRoughness && material.anisotropyStrength > 0.0f);
    if (anisotropic) return material.texture(TextureSlot::Anisotropy).texCoordSet;
    const scenes::TextureUse& coat = material.texture(TextureSlot::ClearcoatNormal);
    return metallicRoughness && material.clearcoat > 0.0f && coat.image != scenes::kNone ? coat.texCoordSet : -1;
}

/// The same of each mesh that is drawn. A mesh drawn with materials that differ follows the first.
std::vector<int> tangentSets(const scenes::Scene& scene) {
    std::vector<int> sets(scene.meshes.size(), -1);
    for (const scenes::Node& node : scene.nodes) {
        for (const scenes::MeshInstance& instance : node.instances) {
            if (!scenes::isDrawn(scene, instance)) continue;
            const scenes::Material& material = scene.materials[std::size_t(instance.material)];
            int& set = sets[std::size_t(instance.mesh)];
            if (set < 0) set = tangentSet(material);
        }
    }
    return sets;
}

} // namespace

VertexStreams makeVertexStreams(const scenes::Scene& scene, const FeatureSet& features) {
    VertexStreams streams;
    const std::vector<int> sets = tangentSets(scene);
    const std::vector<bool> used = scenes::inUse(scene).meshes;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        if (!used[i]) {
            streams.ranges.emplace_back();
            continue;
        }
        const scenes::Mesh& mesh = scene.meshes[i];
        const std::size_t count = mesh.positionsOS.size();
        streams.ranges.push_back({std::uint32_t(streams.indices.size()), std::uint32_t(mesh.indices.size()),
                                  std::int32_t(streams.positionsOS.size())});
        streams.indices.insert(streams.indices.end(), mesh.indices.begin(), mesh.indices.end());
        append(streams.positionsOS, mesh.positionsOS, count, glm::vec3(0.0f));
        append(streams.normalsOS, mesh.normalsOS, count, glm::vec3(0.0f));
        if (features.tangents()) {
            const bool computed = mesh.tangentsOS.empty() && sets[i] >= 0;
            append(streams.tangentsOS, computed ? computeTangents(mesh, std::size_t(sets[i])) : mesh.tangentsOS, count,
                   glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));
        }
        if (features.textures()) append(streams.texCoords[0], mesh.texCoords[0], count, glm::vec2(0.0f));
        if (features[Feature::TexCoord1]) append(streams.texCoords[1], mesh.texCoords[1], count, glm::vec2(0.0f));
        if (features[Feature::VertexColor]) append(streams.colors, mesh.colors, count, glm::vec4(1.0f));
    }
    return streams;
}

} // namespace tessera::frame
