#include "scenes/import/ObjMaterials.h"

#include <algorithm>
#include <cmath>

#include "scenes/import/Files.h"
#include "scenes/import/Importers.h"
#include "scenes/import/MadeImages.h"

namespace tessera::scenes::obj {
namespace {

constexpr float kConstantColour = 0.0f; ///< illum 0
constexpr float kDiffuseOnly = 1.0f;    ///< illum 1
constexpr int kMatte = -1;              ///< the channel of opacity: alpha, or red of images without alpha

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

/// The unlit version of a material, for points and lines, which have no normals.
Material unlitOf(const Material& lit) {
    Material unlit;
    unlit.name = lit.name + ", unlit";
    unlit.model = MaterialModel::SingleColor;
    const glm::vec3 colour = glm::vec3(lit.baseColor) + lit.emissive;
    unlit.baseColor = glm::vec4(glm::min(colour, float(kMostColor)), lit.baseColor.w);
    unlit.texture(TextureSlot::BaseColor) = lit.texture(TextureSlot::BaseColor);
    unlit.alphaMode = lit.alphaMode;
    return unlit;
}

} // namespace

int MaterialConverter::add(const MtlMaterial* mtl, bool isUnlit) {
    Material material;
    if (mtl != nullptr && !mtl->file.empty()) {
        for (const auto& [line, text, repair] : mtl->flaws) repairs_.note(mtl->file, line, repair, "{}", text);
        unsupported_[mtl->file].insert(mtl->unsupported.begin(), mtl->unsupported.end());
        warnOfNothingShown(*mtl);
        material = converted(*mtl);
    } else {
        material.name = mtl == nullptr ? "default" : mtl->name;
        material.baseColor = glm::vec4(0.8f, 0.8f, 0.8f, 1.0f);
        material.metallic = 0.0f;
        material.perceptualRoughness = 0.5f;
    }
    scene_.materials.push_back(isUnlit ? unlitOf(material) : std::move(material));
    return int(scene_.materials.size()) - 1;
}

void MaterialConverter::finish() {
    for (const auto& [file, what] : unsupported_)
        if (!what.empty())
            scene_.warnings.push_back(
                fmt::format("{}: statements that are not supported are left out: {}", file, fmt::join(what, ", ")));
}

Material MaterialConverter::converted(const MtlMaterial& mtl) {
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
        return material;
    }
    setMetallicRoughness(mtl, material);
    if (mtl.ior && *mtl.ior > 1.0f) material.ior = *mtl.ior;
    if (mtl.illumination == kDiffuseOnly) {
        material.specularFactor = 0.0f;
    } else {
        if (mtl.specular) material.specularColor = *mtl.specular;
        if (mtl.specularPicture)
            material.texture(TextureSlot::SpecularColor) =
                textureUse(mtl, *mtl.specularPicture, TextureSlot::SpecularColor);
    }
    if (const std::optional<MtlPicture>& normals = mtl.normalPicture ? mtl.normalPicture : mtl.bumpPicture) {
        if (!mtl.normalPicture)
            warn(mtl, fmt::format("the picture of {} is taken for a tangent-space normal map; if it holds heights, "
                                  "convert it",
                                  normals->keyword));
        material.texture(TextureSlot::Normal) = textureUse(mtl, *normals, TextureSlot::Normal);
        material.normalScale = normals->bumpMultiplier;
    }
    if (mtl.emissionPicture) {
        material.emissive = glm::vec3(1.0f);
        material.texture(TextureSlot::Emissive) = textureUse(mtl, *mtl.emissionPicture, TextureSlot::Emissive);
    }
    if (mtl.emission) material.emissive = *mtl.emission;
    return material;
}

TextureUse MaterialConverter::textureUse(const MtlMaterial& mtl, const MtlPicture& picture, TextureSlot slot) {
    TextureUse use = pictureUse(mtl, picture);
    if (use.image != kNone) return use;
    if (!usesStandIn(slot)) return {};
    use.image = standIn(mtl);
    return use;
}

int MaterialConverter::standIn(const MtlMaterial& mtl) {
    if (standIn_ == kNone) {
        scene_.images.push_back(standInPicture(ledger_, mtl.file + ": a stand-in"));
        standIn_ = int(scene_.images.size()) - 1;
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
    const std::filesystem::path folder = std::filesystem::path(mtl.file).parent_path();
    const auto [entry, isNew] = imageOfFile_.try_emplace((folder / picture.name).string(), kNone);
    if (!isNew) return entry->second;
    const NamedFile file = fileNamed(folder, picture.name);
    const auto [same, isFirst] = imageOfFile_.try_emplace(file.path.lexically_normal().string(), kNone);
    if (!file.isAsNamed)
        repairs_.note(mtl.file, picture.line, "that one is read", "'{}' names '{}', which is there as '{}'",
                      picture.keyword, picture.name, file.path.lexically_relative(folder).string());
    if (same != entry && !isFirst) return entry->second = same->second;
    const std::uint64_t mark = ledger_.usedBytes();
    const auto textOf = [&](const InputError& error) {
        return fmt::format("{}: material '{}', {}: {}", mtl.file, mtl.name, picture.keyword, error.what());
    };
    try {
        scene_.images.push_back(readImage(file.path, ledger_));
    } catch (const MemoryRefused& error) {
        throw MemoryRefused(textOf(error));
    } catch (const InputError& error) {
        if (ledger_.importOptions().isStrict) throw InputError(textOf(error));
        ledger_.settle(mark, 0);
        scene_.warnings.push_back(textOf(error) + kStandInText);
        return kNone;
    }
    return entry->second = same->second = int(scene_.images.size()) - 1;
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
    colour.image = packed(mtl, scene_.images[std::size_t(opacity.image)].name + " as opacity",
                          {{{colour.image, 0}, {colour.image, 1}, {colour.image, 2}, {opacity.image, kMatte}}});
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
    // One image for both is already packed as in glTF, green and blue; two are packed here.
    if (roughness.image != metalness.image)
        use.image = packed(mtl, mtl.name + " roughness and metalness",
                           {{{kNone, 0}, {roughness.image, 0}, {metalness.image, 0}, {kNone, 0}}});
    material.texture(TextureSlot::MetallicRoughness) = use;
}

/// Packs channels of images. Charges for the largest width and height, and for the widest format.
int MaterialConverter::packed(const MtlMaterial& mtl, const std::string& name, const Channels& channels) {
    const auto [entry, isNew] = packed_.try_emplace(channels, kNone);
    if (!isNew) return entry->second;
    std::array<ChannelSource, 4> sources;
    std::uint64_t width = 0, height = 0, bytes = 0;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (channels[i].first == kNone) continue;
        const Image& part = scene_.images[std::size_t(channels[i].first)];
        const int channel = channels[i].second;
        sources[i] = {&part, channel == kMatte ? hasAlpha(part) ? 3 : 0 : channel};
        width = std::max(width, std::uint64_t(part.width));
        height = std::max(height, std::uint64_t(part.height));
        bytes = std::max<std::uint64_t>(bytes, texelBytes(part.format));
    }
    ledger_.charge(width * height * bytes, [&] {
        return fmt::format("{}: material '{}', a picture of {}x{} texels", mtl.file, mtl.name, width, height);
    });
    scene_.images.push_back(packChannels(name, sources));
    return entry->second = int(scene_.images.size()) - 1;
}

/// Warns of values that hide a material or a texture. Files often mean something else by them.
void MaterialConverter::warnOfNothingShown(const MtlMaterial& mtl) {
    constexpr float kRounding = 1e-3f;
    if (mtl.opacity && mtl.transparency && std::abs(*mtl.opacity + *mtl.transparency - 1.0f) > kRounding)
        warn(mtl, fmt::format("'d' is {} and 'Tr' is {}, which contradict each other; 'd' counts", *mtl.opacity,
                              *mtl.transparency));
    if (mtl.opacity.value_or(1.0f - mtl.transparency.value_or(0.0f)) == 0.0f)
        warn(mtl, mtl.opacity ? "'d' is 0, which makes it invisible; 1 is opaque"
                              : "'Tr' is 1, which makes it invisible; if it should be opaque, write 'Tr 0' or 'd 1'");
    const auto warnOfProduct = [&](const char* keyword, bool isZero, const std::optional<MtlPicture>& picture) {
        if (isZero && picture)
            warn(mtl,
                 fmt::format("'{}' is 0 and is multiplied by the picture of {}, which is not seen; write 1 to see it",
                             keyword, picture->keyword));
    };
    warnOfProduct("Kd", mtl.diffuse == glm::vec3(0.0f), mtl.diffusePicture);
    if (mtl.illumination == kConstantColour) return;
    warnOfProduct("Ks", mtl.specular == glm::vec3(0.0f), mtl.specularPicture);
    warnOfProduct("Ke", mtl.emission == glm::vec3(0.0f), mtl.emissionPicture);
    warnOfProduct("Pr", mtl.perceptualRoughness == 0.0f, mtl.roughnessPicture);
    warnOfProduct("Pm", mtl.metalness == 0.0f, mtl.metalnessPicture);
}

void MaterialConverter::warn(const MtlMaterial& mtl, const std::string& what) {
    scene_.warnings.push_back(fmt::format("{}: material '{}': {}", mtl.file, mtl.name, what));
}

} // namespace tessera::scenes::obj
