#include "scenes/import/GltfMaterials.h"

#include <algorithm>

#include <fmt/format.h>

#include "scenes/import/GltfImages.h"
#include "scenes/import/PackChannels.h"
#include "scenes/import/StandIn.h"

namespace tessera::scenes::gltf {

int Materials::material(int index) {
    if (const auto found = materials_.find(index); found != materials_.end()) return found->second;
    Material material;
    material.name = "default";
    if (index >= 0) material = convert(index);
    context_.scene.materials.push_back(std::move(material));
    return materials_[index] = static_cast<int>(context_.scene.materials.size()) - 1;
}

Material Materials::convert(int index) {
    const model::Material& stored = context_.document.model.materials[static_cast<std::size_t>(index)];
    const std::string place = fmt::format("/materials/{}", index);
    constexpr std::size_t kCopies = 2; // while a vector grows
    context_.document.charge(kCopies * (sizeof(Material) + stored.surface.name.size()), "materials", index);
    Material material = stored.surface;
    material.name = nameOr(material.name, "material", index);
    const bool isUnlit = material.model == MaterialModel::SingleColor;
    for (std::size_t i = 0; i < stored.textures.size(); ++i) {
        const auto& [path, slot] = model::kTexturePlaces[i];
        if (isUnlit && slot != TextureSlot::BaseColor) continue;
        const bool isReplaced = slot == TextureSlot::BaseColor || slot == TextureSlot::MetallicRoughness ||
                                slot == TextureSlot::SpecularColor || slot == TextureSlot::SpecularFactor;
        if (stored.specularGlossiness && isReplaced) continue;
        material.texture(slot) = use(stored.textures[i], slot, fmt::format("{}/{}", place, path));
    }
    if (isUnlit) return material;
    if (stored.ior != 0.0 && stored.ior < 1.0)
        context_.document.fail(place + "/extensions/KHR_materials_ior/ior",
                               fmt::format("is {}; it must be 0 or at least 1", stored.ior));
    material.ior = static_cast<float>(stored.ior);
    if (stored.specularGlossiness)
        convertSpecularGlossiness(*stored.specularGlossiness, place + "/extensions/KHR_materials_pbrSpecularGlossiness",
                                  material);
    return material;
}

/// With an index of refraction of 0 a dielectric reflects all light, and its tint is what the extension calls specular:
/// both give F0, with F90 = 1, and what is reflected is taken from the diffuse part.
/// Source: KHR_materials_ior, "Implementation": its mode for specular-glossiness materials.
void Materials::convertSpecularGlossiness(const model::SpecularGlossiness& stored, const std::string& place,
                                          Material& material) {
    constexpr const char* kNote = "materials of specular and glossiness (KHR_materials_pbrSpecularGlossiness) are "
                                  "converted to dielectrics of roughness 1 - glossiness, tinted as their specular";
    std::vector<std::string>& notes = context_.scene.notes;
    if (std::ranges::find(notes, kNote) == notes.end()) notes.emplace_back(kNote);
    material.baseColor = stored.diffuse;
    material.texture(TextureSlot::BaseColor) =
        use(stored.diffuseTexture, TextureSlot::BaseColor, place + "/diffuseTexture");
    material.ior = 0.0f;
    material.metallic = 0.0f;
    material.specularFactor = 1.0f;
    material.specularColor = stored.specular;
    material.perceptualRoughness = 1.0f - stored.glossiness;
    const TextureUse both =
        use(stored.specularGlossinessTexture, TextureSlot::SpecularColor, place + "/specularGlossinessTexture");
    material.texture(TextureSlot::SpecularColor) = both;
    if (both.image == kNone || both.image == standIn_) return;
    material.perceptualRoughness = 1.0f;
    TextureUse& roughness = material.texture(TextureSlot::MetallicRoughness) = both;
    roughness.image = roughnessOf(both.image, stored.glossiness);
}

int Materials::roughnessOf(int image, float glossiness) {
    const auto [entry, isNew] = roughness_.try_emplace({image, glossiness}, kNone);
    if (!isNew) return entry->second;
    std::vector<Image>& images = context_.scene.images;
    const Image& alpha = images[static_cast<std::size_t>(image)];
    context_.document.ledger.charge(alpha.texels.size(), [&] {
        return fmt::format("{}: the roughness of '{}'", context_.document.file, alpha.name);
    });
    const ChannelSource roughness{&alpha, 3, -double(glossiness), 1.0};
    Image packed = packChannels(alpha.name + " as roughness", {ChannelSource{}, roughness, ChannelSource{}, {}});
    images.push_back(std::move(packed));
    return entry->second = static_cast<int>(images.size()) - 1;
}

std::optional<int> Materials::imported(int index) const {
    const auto found = materials_.find(index);
    return found == materials_.end() ? std::nullopt : std::optional(found->second);
}

TextureUse Materials::use(const model::TextureInfo& info, TextureSlot slot, const std::string& place) {
    if (info.texture == kNone) return {};
    if (info.texCoordSet > 1) {
        context_.warn(
            fmt::format("{}: uses texture coordinate set {}; only 0 and 1 are supported, so the texture is left out",
                        place, info.texCoordSet));
        return {};
    }
    const model::Model& model = context_.document.model;
    const model::Texture& texture = model.textures[static_cast<std::size_t>(info.texture)];
    int picture = kNone;
    if (texture.webp != kNone)
        picture = image(texture.webp,
                        texture.source == kNone ? kStandInText : "; the texture's other picture is used instead");
    if (picture == kNone && texture.source != kNone) picture = image(texture.source, kStandInText);
    if (texture.source == kNone && texture.webp == kNone) {
        const std::string textureAt = fmt::format("/textures/{}", info.texture);
        constexpr const char* kWhat = "has no source in a supported format; store it as PNG or JPEG";
        if (context_.document.ledger.wishes().isStrict) context_.document.fail(textureAt, kWhat);
        context_.warn(fmt::format("{}: {}{}", textureAt, kWhat, kStandInText));
    }
    if (picture == kNone && !takesStandIn(slot)) return {};
    TextureUse use{picture == kNone ? standIn() : picture, {}, info.texCoordSet, info.transform};
    if (texture.sampler != kNone) use.sampler = model.samplers[static_cast<std::size_t>(texture.sampler)];
    return use;
}

int Materials::image(int index, const char* instead) {
    const auto [entry, isNew] = images_.try_emplace(index, kNone);
    if (!isNew) return entry->second;
    std::optional<Image> readable = readableImage(context_, index, instead);
    if (!readable) return kNone;
    context_.scene.images.push_back(std::move(*readable));
    return entry->second = static_cast<int>(context_.scene.images.size()) - 1;
}

int Materials::standIn() {
    if (standIn_ == kNone) {
        const std::string& file = context_.document.file;
        context_.scene.images.push_back(standInPicture(context_.document.ledger, file + ": a stand-in"));
        standIn_ = static_cast<int>(context_.scene.images.size()) - 1;
    }
    return standIn_;
}

} // namespace tessera::scenes::gltf
