#include "scenes/import/GltfMaterials.h"

#include <fmt/format.h>

namespace tessera::scenes::gltf {
namespace {

glm::vec3 colorOf(const std::vector<double>& values, glm::vec3 otherwise) {
    return values.size() < 3 ? otherwise : glm::vec3(values[0], values[1], values[2]);
}

glm::vec3 colorIn(const tinygltf::Value& object, const std::string& name, glm::vec3 otherwise) {
    if (!object.Has(name)) return otherwise;
    const tinygltf::Value& color = object.Get(name);
    return {color.Get(0).GetNumberAsDouble(), color.Get(1).GetNumberAsDouble(), color.Get(2).GetNumberAsDouble()};
}

AlphaMode alphaModeOf(const std::string& name) {
    if (name == "MASK") return AlphaMode::Mask;
    return name == "BLEND" ? AlphaMode::Blend : AlphaMode::Opaque;
}

} // namespace

int Materials::material(int index) {
    if (const auto found = imported_.find(index); found != imported_.end()) return found->second;
    Material material;
    material.name = "default";
    if (index >= 0) material = convert(index);
    context_.scene.materials.push_back(std::move(material));
    return imported_[index] = static_cast<int>(context_.scene.materials.size()) - 1;
}

Material Materials::convert(int index) {
    const tinygltf::Material& stored = context_.document.model.materials[static_cast<std::size_t>(index)];
    const tinygltf::PbrMetallicRoughness& pbr = stored.pbrMetallicRoughness;
    const std::string place = fmt::format("/materials/{}", index);
    Material material;
    material.name = nameOr(stored.name, "material", index);
    const std::vector<double>& base = pbr.baseColorFactor;
    if (base.size() == 4) material.baseColor = glm::vec4(base[0], base[1], base[2], base[3]);
    material.metallic = static_cast<float>(pbr.metallicFactor);
    material.perceptualRoughness = static_cast<float>(pbr.roughnessFactor);
    material.emissive = colorOf(stored.emissiveFactor, material.emissive);
    material.normalScale = static_cast<float>(stored.normalTexture.scale);
    material.alphaMode = alphaModeOf(stored.alphaMode);
    material.alphaCutoff = static_cast<float>(stored.alphaCutoff);
    material.doubleSided = stored.doubleSided;

    const bool isUnlit = findExtension(stored.extensions, "KHR_materials_unlit") != nullptr;
    if (isUnlit) material.model = MaterialModel::SingleColor;
    material.texture(TextureSlot::BaseColor) =
        textures_.use(referenceOf(pbr.baseColorTexture), place + "/pbrMetallicRoughness/baseColorTexture");
    // An unlit material is its base colour; the rest is a fallback for programs that do not know the extension.
    if (isUnlit) {
        material.emissive = glm::vec3(0.0f);
        return material;
    }
    material.texture(TextureSlot::MetallicRoughness) = textures_.use(
        referenceOf(pbr.metallicRoughnessTexture), place + "/pbrMetallicRoughness/metallicRoughnessTexture");
    material.texture(TextureSlot::Normal) = textures_.use(referenceOf(stored.normalTexture), place + "/normalTexture");
    material.texture(TextureSlot::Emissive) =
        textures_.use(referenceOf(stored.emissiveTexture), place + "/emissiveTexture");
    if (stored.occlusionTexture.index >= 0)
        context_.warn("occlusion textures are left out (they dim environment light only, which is not shaded)");
    if (const auto* strength = findExtension(stored.extensions, "KHR_materials_emissive_strength"))
        material.emissive *= static_cast<float>(numberIn(*strength, "emissiveStrength", 1.0));
    if (const auto* ior = findExtension(stored.extensions, "KHR_materials_ior")) {
        const double index2Over1 = numberIn(*ior, "ior", 1.5);
        if (index2Over1 != 0.0 && index2Over1 < 1.0)
            context_.document.fail(place + "/extensions/KHR_materials_ior/ior",
                                   fmt::format("is {}; it must be 0 or at least 1", index2Over1));
        material.ior = static_cast<float>(index2Over1);
    }
    convertSpecular(stored, place, material);
    convertAnisotropy(stored, place, material);
    convertClearcoat(stored, place, material);
    convertSheen(stored, place, material);
    return material;
}

void Materials::convertSpecular(const tinygltf::Material& stored, const std::string& place, Material& material) {
    const tinygltf::Value* specular = findExtension(stored.extensions, "KHR_materials_specular");
    if (specular == nullptr) return;
    const std::string specularPlace = place + "/extensions/KHR_materials_specular";
    material.specularFactor = static_cast<float>(numberIn(*specular, "specularFactor", 1.0));
    material.specularColor = colorIn(*specular, "specularColorFactor", material.specularColor);
    material.texture(TextureSlot::SpecularFactor) =
        textures_.use(referenceIn(*specular, "specularTexture"), specularPlace + "/specularTexture");
    material.texture(TextureSlot::SpecularColor) =
        textures_.use(referenceIn(*specular, "specularColorTexture"), specularPlace + "/specularColorTexture");
}

void Materials::convertAnisotropy(const tinygltf::Material& stored, const std::string& place, Material& material) {
    const tinygltf::Value* anisotropy = findExtension(stored.extensions, "KHR_materials_anisotropy");
    if (anisotropy == nullptr) return;
    material.anisotropyStrength = static_cast<float>(numberIn(*anisotropy, "anisotropyStrength", 0.0));
    material.anisotropyRotationRadians = static_cast<float>(numberIn(*anisotropy, "anisotropyRotation", 0.0));
    material.texture(TextureSlot::Anisotropy) =
        textures_.use(referenceIn(*anisotropy, "anisotropyTexture"),
                      place + "/extensions/KHR_materials_anisotropy/anisotropyTexture");
}

void Materials::convertClearcoat(const tinygltf::Material& stored, const std::string& place, Material& material) {
    const tinygltf::Value* coat = findExtension(stored.extensions, "KHR_materials_clearcoat");
    if (coat == nullptr) return;
    material.clearcoat = static_cast<float>(numberIn(*coat, "clearcoatFactor", 0.0));
    material.clearcoatPerceptualRoughness = static_cast<float>(numberIn(*coat, "clearcoatRoughnessFactor", 0.0));
    const std::string coatPlace = place + "/extensions/KHR_materials_clearcoat";
    material.texture(TextureSlot::Clearcoat) =
        textures_.use(referenceIn(*coat, "clearcoatTexture"), coatPlace + "/clearcoatTexture");
    material.texture(TextureSlot::ClearcoatRoughness) =
        textures_.use(referenceIn(*coat, "clearcoatRoughnessTexture"), coatPlace + "/clearcoatRoughnessTexture");
    material.texture(TextureSlot::ClearcoatNormal) =
        textures_.use(referenceIn(*coat, "clearcoatNormalTexture"), coatPlace + "/clearcoatNormalTexture");
    if (coat->Has("clearcoatNormalTexture"))
        material.clearcoatNormalScale = static_cast<float>(numberIn(coat->Get("clearcoatNormalTexture"), "scale", 1.0));
}

void Materials::convertSheen(const tinygltf::Material& stored, const std::string& place, Material& material) {
    const tinygltf::Value* sheen = findExtension(stored.extensions, "KHR_materials_sheen");
    if (sheen == nullptr) return;
    material.sheenColor = colorIn(*sheen, "sheenColorFactor", material.sheenColor);
    material.sheenPerceptualRoughness = static_cast<float>(numberIn(*sheen, "sheenRoughnessFactor", 0.0));
    const std::string sheenPlace = place + "/extensions/KHR_materials_sheen";
    material.texture(TextureSlot::SheenColor) =
        textures_.use(referenceIn(*sheen, "sheenColorTexture"), sheenPlace + "/sheenColorTexture");
    material.texture(TextureSlot::SheenRoughness) =
        textures_.use(referenceIn(*sheen, "sheenRoughnessTexture"), sheenPlace + "/sheenRoughnessTexture");
}

} // namespace tessera::scenes::gltf
