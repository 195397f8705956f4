#include "scenes/import/ObjMaterials.h"

#include <algorithm>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/import/Importers.h"
#include "scenes/import/PackChannels.h"
#include "scenes/import/StandIn.h"

namespace tessera::scenes::obj {
namespace {

constexpr float kConstantColour = 0.0f; ///< illum 0
constexpr float kDiffuseOnly = 1.0f;    ///< illum 1

/// The perceptual roughness whose GGX lobe is about as wide as a Blinn-Phong lobe of this exponent.
/// Source: Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", section 5.4: the Phong
/// distribution of exponent p looks like Beckmann's, and so about like GGX's, with p = 2 / alpha^2 - 2, hence
/// alpha = sqrt(2 / (p + 2)); perceptual roughness is alpha's square root.
float perceptualRoughnessOf(float exponent) {
    return std::sqrt(std::sqrt(2.0f / (exponent + 2.0f)));
}

/// MTL's v points up from the bottom-left corner, the scene's down from the top-left one: v = 1 - v'.
TextureTransform transformOf(const MtlPicture& picture) {
    TextureTransform transform;
    transform.scale = picture.scale;
    transform.offset = {picture.offset.x, 1.0f - picture.scale.y - picture.offset.y};
    return transform;
}

/// The picture's path, with the separators of other systems where only those lead to a file.
std::filesystem::path pathOf(const MtlMaterial& mtl, const std::string& name) {
    const std::filesystem::path folder = std::filesystem::path(mtl.file).parent_path();
    std::error_code failure;
    if (std::filesystem::exists(folder / name, failure)) return folder / name;
    std::string slashed = name;
    std::ranges::replace(slashed, '\\', '/');
    return std::filesystem::exists(folder / slashed, failure) ? folder / slashed : folder / name;
}

} // namespace

int MaterialConverter::add(const MtlMaterial& mtl) {
    Material material;
    material.name = mtl.name;
    material.metallic = 0.0f;
    material.perceptualRoughness = 0.5f;
    if (mtl.diffuse) material.baseColor = glm::vec4(*mtl.diffuse, 1.0f);
    if (mtl.diffusePicture)
        material.texture(TextureSlot::BaseColor) = textureUse(mtl, *mtl.diffusePicture, TextureSlot::BaseColor);
    setOpacity(mtl, material);
    if (mtl.illumination == kConstantColour) {
        material.model = MaterialModel::SingleColor;
    } else {
        setMetallicRoughness(mtl, material);
        setSpecular(mtl, material);
        setNormalMap(mtl, material);
        if (mtl.emissionPicture) {
            material.emissive = glm::vec3(1.0f);
            material.texture(TextureSlot::Emissive) = textureUse(mtl, *mtl.emissionPicture, TextureSlot::Emissive);
        }
        if (mtl.emission) material.emissive = *mtl.emission;
    }
    scene_.materials.push_back(std::move(material));
    return static_cast<int>(scene_.materials.size()) - 1;
}

int MaterialConverter::addDefault(const std::string& name) {
    Material material;
    material.name = name;
    material.baseColor = glm::vec4(0.8f, 0.8f, 0.8f, 1.0f);
    material.metallic = 0.0f;
    material.perceptualRoughness = 0.5f;
    scene_.materials.push_back(std::move(material));
    return static_cast<int>(scene_.materials.size()) - 1;
}

TextureUse MaterialConverter::textureUse(const MtlMaterial& mtl, const MtlPicture& picture, TextureSlot slot) {
    TextureUse use = pictureUse(mtl, picture);
    if (use.image != kNone) return use;
    if (!takesStandIn(slot)) return {};
    use.image = standIn(mtl);
    return use;
}

int MaterialConverter::standIn(const MtlMaterial& mtl) {
    if (standIn_ == kNone) {
        scene_.images.push_back(standInPicture(ledger_, mtl.file + ": a stand-in"));
        standIn_ = static_cast<int>(scene_.images.size()) - 1;
    }
    return standIn_;
}

TextureUse MaterialConverter::pictureUse(const MtlMaterial& mtl, const MtlPicture& picture) {
    TextureUse use;
    use.image = image(mtl, picture);
    use.transform = transformOf(picture);
    if (picture.clamp) use.sampler.wrapU = use.sampler.wrapV = Wrap::ClampToEdge;
    return use;
}

int MaterialConverter::image(const MtlMaterial& mtl, const MtlPicture& picture) {
    const std::filesystem::path path = pathOf(mtl, picture.name);
    const auto [entry, isNew] = imageOfFile_.try_emplace(path.lexically_normal().string(), kNone);
    if (!isNew) return entry->second;
    const std::uint64_t mark = ledger_.usedBytes();
    const auto textOf = [&](const InputError& error) {
        return fmt::format("{}: material '{}', {}: {}", mtl.file, mtl.name, picture.keyword, error.what());
    };
    try {
        scene_.images.push_back(readImage(path, ledger_));
    } catch (const MemoryRefused& error) {
        throw MemoryRefused(textOf(error));
    } catch (const InputError& error) {
        if (ledger_.wishes().isStrict) throw InputError(textOf(error));
        ledger_.settle(mark, 0);
        scene_.warnings.push_back(textOf(error) + kStandInText);
        return kNone;
    }
    return entry->second = static_cast<int>(scene_.images.size()) - 1;
}

void MaterialConverter::setOpacity(const MtlMaterial& mtl, Material& material) {
    material.baseColor.w = mtl.opacity.value_or(1.0f - mtl.transparency.value_or(0.0f));
    if (!mtl.opacityPicture) {
        if (material.baseColor.w < 1.0f) material.alphaMode = AlphaMode::Blend;
        return;
    }
    material.alphaMode = AlphaMode::Mask;
    TextureUse& colour = material.texture(TextureSlot::BaseColor);
    const TextureUse opacity = pictureUse(mtl, *mtl.opacityPicture);
    if (opacity.image == kNone) { // it cannot be read
        material.alphaMode = material.baseColor.w < 1.0f ? AlphaMode::Blend : AlphaMode::Opaque;
        return;
    }
    if (opacity.image == colour.image) return; // its alpha is the opacity already
    if (colour.image == kNone) {
        colour = opacity;
        colour.image = kNone;
    } else if (colour.transform != opacity.transform || colour.sampler != opacity.sampler) {
        warn(mtl, "map_d is placed as map_Kd is; its own options are left out");
    }
    const auto [entry, isNew] = colourAndOpacity_.try_emplace({colour.image, opacity.image}, kNone);
    if (isNew) {
        charge(colour.image, opacity.image, mtl);
        const Image* rgb = colour.image == kNone ? nullptr : &scene_.images[static_cast<std::size_t>(colour.image)];
        const Image& mask = scene_.images[static_cast<std::size_t>(opacity.image)];
        const int channel = hasAlpha(mask) ? 3 : 0; // MTL's default is the matte channel; grey pictures hold it in red
        Image image =
            packChannels(mask.name + " as opacity", {ChannelSource{rgb, 0}, {rgb, 1}, {rgb, 2}, {&mask, channel}});
        scene_.images.push_back(std::move(image));
        entry->second = static_cast<int>(scene_.images.size()) - 1;
    }
    colour.image = entry->second;
}

void MaterialConverter::setMetallicRoughness(const MtlMaterial& mtl, Material& material) {
    if (mtl.perceptualRoughness)
        material.perceptualRoughness = *mtl.perceptualRoughness;
    else if (mtl.roughnessPicture)
        material.perceptualRoughness = 1.0f;
    else if (mtl.exponent)
        material.perceptualRoughness = perceptualRoughnessOf(*mtl.exponent);
    if (mtl.metalness)
        material.metallic = *mtl.metalness;
    else if (mtl.metalnessPicture)
        material.metallic = 1.0f;
    if (!mtl.roughnessPicture && !mtl.metalnessPicture) return;

    TextureUse roughness;
    TextureUse metalness;
    if (mtl.roughnessPicture) roughness = pictureUse(mtl, *mtl.roughnessPicture);
    if (mtl.metalnessPicture) metalness = pictureUse(mtl, *mtl.metalnessPicture);
    if (roughness.image == kNone && metalness.image == kNone) return; // they cannot be read
    TextureUse use = roughness.image != kNone ? roughness : metalness;
    if (roughness.image != kNone && metalness.image != kNone &&
        (roughness.transform != metalness.transform || roughness.sampler != metalness.sampler))
        warn(mtl, "map_Pm is placed as map_Pr is; its own options are left out");
    // One picture for both is packed as in glTF, green and blue; two are packed here.
    if (roughness.image != metalness.image) {
        const auto [entry, isNew] = roughnessAndMetalness_.try_emplace({roughness.image, metalness.image}, kNone);
        if (isNew) {
            charge(roughness.image, metalness.image, mtl);
            const auto source = [&](int image) {
                return ChannelSource{image == kNone ? nullptr : &scene_.images[static_cast<std::size_t>(image)], 0};
            };
            Image image =
                packChannels(mtl.name + " roughness and metalness",
                             {ChannelSource{}, source(roughness.image), source(metalness.image), ChannelSource{}});
            scene_.images.push_back(std::move(image));
            entry->second = static_cast<int>(scene_.images.size()) - 1;
        }
        use.image = entry->second;
    }
    material.texture(TextureSlot::MetallicRoughness) = use;
}

void MaterialConverter::setSpecular(const MtlMaterial& mtl, Material& material) {
    if (mtl.ior && *mtl.ior > 1.0f) material.ior = *mtl.ior;
    if (mtl.illumination == kDiffuseOnly) {
        material.specularFactor = 0.0f;
        return;
    }
    if (mtl.specular) material.specularColor = glm::min(*mtl.specular, glm::vec3(1.0f));
    if (mtl.specularPicture)
        material.texture(TextureSlot::SpecularColor) =
            textureUse(mtl, *mtl.specularPicture, TextureSlot::SpecularColor);
}

void MaterialConverter::setNormalMap(const MtlMaterial& mtl, Material& material) {
    const std::optional<MtlPicture>& picture = mtl.normalPicture ? mtl.normalPicture : mtl.bumpPicture;
    if (!picture) return;
    if (!mtl.normalPicture)
        warn(mtl, fmt::format("the picture of {} is taken for a tangent-space normal map; if it holds heights, "
                              "convert it",
                              picture->keyword));
    material.texture(TextureSlot::Normal) = textureUse(mtl, *picture, TextureSlot::Normal);
    material.normalScale = picture->bumpMultiplier;
}

/// For a picture packed of two: as wide and as high as the larger, in at most the wider format.
void MaterialConverter::charge(int image, int other, const MtlMaterial& mtl) {
    std::uint64_t width = 0, height = 0, bytes = 0;
    for (const int one : {image, other}) {
        if (one == kNone) continue;
        const Image& part = scene_.images[static_cast<std::size_t>(one)];
        width = std::max(width, static_cast<std::uint64_t>(part.width));
        height = std::max(height, static_cast<std::uint64_t>(part.height));
        bytes = std::max<std::uint64_t>(bytes, texelBytes(part.format));
    }
    ledger_.charge(width * height * bytes, [&] {
        return fmt::format("{}: material '{}', a picture of {}x{} texels", mtl.file, mtl.name, width, height);
    });
}

void MaterialConverter::warn(const MtlMaterial& mtl, const std::string& what) {
    scene_.warnings.push_back(fmt::format("{}: material '{}': {}", mtl.file, mtl.name, what));
}

} // namespace tessera::scenes::obj
