#include "renderer/frame/PackedMaterial.h"

#include <cmath>

#include "shaders/shared/models.h"

namespace tessera::frame {

namespace {

using scenes::MaterialModel;
using scenes::TextureSlot;

static_assert(unsigned(MaterialModel::SingleColor) == MODEL_SINGLE_COLOR &&
              unsigned(MaterialModel::Lambert) == MODEL_LAMBERT);
static_assert(unsigned(MaterialModel::Microfacet) == MODEL_MICROFACET);
static_assert(unsigned(MaterialModel::MetallicRoughness) == MODEL_METALLIC_ROUGHNESS);
static_assert(int(TextureSlot::BaseColor) == TEXTURE_SLOT_BASE_COLOR &&
              int(TextureSlot::Normal) == TEXTURE_SLOT_NORMAL);
static_assert(int(TextureSlot::MetallicRoughness) == TEXTURE_SLOT_METALLIC_ROUGHNESS);
static_assert(int(TextureSlot::Emissive) == TEXTURE_SLOT_EMISSIVE && int(TextureSlot::Ior) == TEXTURE_SLOT_IOR);
static_assert(int(TextureSlot::SpecularFactor) == TEXTURE_SLOT_SPECULAR_FACTOR);
static_assert(int(TextureSlot::SpecularColor) == TEXTURE_SLOT_SPECULAR_COLOR &&
              int(TextureSlot::Count) == TEXTURE_SLOT_COUNT);

glm::uint materialFlags(const scenes::Material& material) {
    glm::uint flags = 0;
    if (material.texture(TextureSlot::Normal).image != scenes::kNone) flags |= MATERIAL_FLAG_NORMAL_MAP;
    if (material.normalMapSpace == scenes::NormalMapSpace::Object) flags |= MATERIAL_FLAG_OBJECT_SPACE_NORMAL;
    if (material.alphaMode == scenes::AlphaMode::Mask) flags |= MATERIAL_FLAG_ALPHA_MASK;
    if (material.doubleSided) flags |= MATERIAL_FLAG_DOUBLE_SIDED;
    if (material.texture(TextureSlot::Ior).image != scenes::kNone) flags |= MATERIAL_FLAG_IOR_TEXTURE;
    return flags;
}

/// KHR_texture_transform: offset + rotation x scale x uv, as two rows.
void packTexture(const scenes::TextureUse& use, glm::vec4& row0, glm::vec4& row1) {
    const double c = std::cos(double(use.transform.rotationRadians)),
                 s = std::sin(double(use.transform.rotationRadians));
    const scenes::TextureTransform& t = use.transform;
    row0 = glm::vec4(float(c * t.scale.x), float(s * t.scale.y), t.offset.x, float(use.texCoordSet));
    row1 = glm::vec4(float(-s * t.scale.x), float(c * t.scale.y), t.offset.y,
                     float(int(use.sampler.wrapU) + 4 * int(use.sampler.wrapV)));
}

} // namespace

shared::MaterialConstants packMaterial(const scenes::Material& material) {
    const bool metallicRoughness = material.model == MaterialModel::MetallicRoughness;
    shared::MaterialConstants packed{};
    packed.baseColor = material.baseColor;
    packed.emissive = glm::vec4(material.emissive, material.alphaCutoff);
    packed.microsurface =
        glm::vec4(material.metallic, metallicRoughness ? material.perceptualRoughness : material.alpha, material.ior,
                  material.normalScale);
    packed.specular = glm::vec4(material.specularColor, material.specularFactor);
    const double contrast = (double(material.ior) - 1.0) / (double(material.ior) + 1.0);
    packed.dielectric = glm::vec4(float(contrast * contrast), 0.0f, 0.0f, 0.0f);
    packed.kind = glm::uvec4(glm::uint(material.model), materialFlags(material), 0u, 0u);
    for (std::size_t slot = 0; slot < scenes::kTextureSlotCount; ++slot) {
        packTexture(material.textures[slot], packed.uvRow0[slot], packed.uvRow1[slot]);
    }
    return packed;
}

bool slotIsSrgb(TextureSlot slot) {
    return slot == TextureSlot::BaseColor || slot == TextureSlot::Emissive || slot == TextureSlot::SpecularColor;
}

} // namespace tessera::frame
