#include "renderer/frame/HoldColors.h"

#include <algorithm>

namespace tessera::frame {

namespace {

using scenes::TextureSlot;

bool exceedsOne(const scenes::Scene& scene, const glm::vec3& factor, const scenes::TextureUse& texture) {
    const bool isFloat = texture.image != scenes::kNone &&
                         scene.images[std::size_t(texture.image)].format == scenes::TexelFormat::Rgba32Float;
    return isFloat || std::max({factor.r, factor.g, factor.b}) > 1.0f;
}

bool exceedsOne(const scenes::Mesh& mesh) {
    return std::any_of(mesh.colors.begin(), mesh.colors.end(), [](const glm::vec4& color) {
        return std::max({color.r, color.g, color.b}) > 1.0f;
    });
}

} // namespace

GBufferLayout holdingColors(GBufferLayout layout, const scenes::Scene& scene) {
    Encoding& albedo = layout.encoding[std::size_t(Channel::Albedo)];
    Encoding& specular = layout.encoding[std::size_t(Channel::Specular)];
    for (const scenes::Material& material : scene.materials) {
        // The colour of single_color is radiance, and goes to another channel.
        if (material.model == scenes::MaterialModel::SingleColor) continue;
        if (exceedsOne(scene, glm::vec3(material.baseColor), material.texture(TextureSlot::BaseColor)))
            albedo = Encoding::Exact;
        // The F0 of metallic_roughness is held to 1 before it is stored.
        if (material.model != scenes::MaterialModel::MetallicRoughness &&
            exceedsOne(scene, material.specularColor, material.texture(TextureSlot::SpecularColor)))
            specular = Encoding::Exact;
    }
    if (albedo != Encoding::Exact && std::any_of(scene.meshes.begin(), scene.meshes.end(),
                                                 [](const scenes::Mesh& mesh) { return exceedsOne(mesh); }))
        albedo = Encoding::Exact;
    return layout;
}

} // namespace tessera::frame
