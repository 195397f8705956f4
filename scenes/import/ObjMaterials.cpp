#include "scenes/import/ObjMaterials.h"

#include <algorithm>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/import/Importers.h"
#include "scenes/import/PackChannels.h"

namespace tessera::scenes::obj {
namespace {

constexpr int kConstantColour = 0; ///< illum 0
constexpr int kDiffuseOnly = 1;    ///< illum 1

glm::vec3 colourOf(const tinyobj::real_t (&values)[3]) {
    return {values[0], values[1], values[2]};
}

/// The perceptual roughness whose GGX lobe is about as wide as a Blinn-Phong lobe of this exponent.
/// Source: Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", section 5.4: the Phong
/// distribution of exponent p looks like Beckmann's, and so about like GGX's, with p = 2 / alpha^2 - 2, hence
/// alpha = sqrt(2 / (p + 2)); perceptual roughness is alpha's square root.
float perceptualRoughnessOf(float exponent) {
    return std::sqrt(std::sqrt(2.0f / (exponent + 2.0f)));
}

/// MTL's v points up from the bottom-left corner, the scene's down from the top-left one: v = 1 - v'.
TextureTransform transformOf(const tinyobj::texture_option_t& options) {
    TextureTransform transform;
    transform.scale = {options.scale[0], options.scale[1]};
    transform.offset = {options.origin_offset[0], 1.0f - options.scale[1] - options.origin_offset[1]};
    return transform;
}

/// The picture's path, with the separators of other systems where only those lead to a file.
std::filesystem::path pathOf(const MtlMaterial& mtl, const std::string& name) {
    const std::filesystem::path folder = mtl.file.parent_path();
    std::error_code failure;
    if (std::filesystem::exists(folder / name, failure)) return folder / name;
    std::string slashed = name;
    std::ranges::replace(slashed, '\\', '/');
    return std::filesystem::exists(folder / slashed, failure) ? folder / slashed : folder / name;
}

} // namespace

int MaterialConverter::add(const MtlMaterial& mtl) {
    const tinyobj::material_t& values = mtl.values;
    Material material;
    material.name = mtl.name;
    material.metallic = 0.0f;
    material.perceptualRoughness = 0.5f;
    if (mtl.states("Kd")) material.baseColor = glm::vec4(colourOf(values.diffuse), 1.0f);
    if (mtl.states("map_Kd"))
        material.texture(TextureSlot::BaseColor) =
            textureUse(mtl, "map_Kd", values.diffuse_texname, values.diffuse_texopt);
    setOpacity(mtl, material);
    if (mtl.states("illum") && values.illum == kConstantColour) {
        material.model = MaterialModel::SingleColor;
    } else {
        setMetallicRoughness(mtl, material);
        setSpecular(mtl, material);
        setNormalMap(mtl, material);
        if (mtl.states("Ke")) material.emissive = colourOf(values.emission);
        if (mtl.states("map_Ke")) {
            if (!mtl.states("Ke")) material.emissive = glm::vec3(1.0f);
            material.texture(TextureSlot::Emissive) =
                textureUse(mtl, "map_Ke", values.emissive_texname, values.emissive_texopt);
        }
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

TextureUse MaterialConverter::textureUse(const MtlMaterial& mtl, const char* keyword, const std::string& name,
                                         const tinyobj::texture_option_t& options) {
    TextureUse use;
    use.image = image(mtl, keyword, name);
    use.transform = transformOf(options);
    if (options.clamp) use.sampler.wrapU = use.sampler.wrapV = Wrap::ClampToEdge;
    return use;
}

int MaterialConverter::image(const MtlMaterial& mtl, const char* keyword, const std::string& name) {
    const std::filesystem::path path = pathOf(mtl, name);
    const auto [entry, isNew] = imageOfFile_.try_emplace(path.lexically_normal().string(), kNone);
    if (!isNew) return entry->second;
    try {
        scene_.images.push_back(readImage(path, ledger_));
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: material '{}', {}: {}", mtl.file.string(), mtl.name, keyword, error.what()));
    }
    return entry->second = static_cast<int>(scene_.images.size()) - 1;
}

void MaterialConverter::setOpacity(const MtlMaterial& mtl, Material& material) {
    const tinyobj::material_t& values = mtl.values;
    material.baseColor.w = values.dissolve;
    if (!mtl.states("map_d")) {
        if (values.dissolve < 1.0f) material.alphaMode = AlphaMode::Blend;
        return;
    }
    material.alphaMode = AlphaMode::Mask;
    TextureUse& colour = material.texture(TextureSlot::BaseColor);
    const TextureUse opacity = textureUse(mtl, "map_d", values.alpha_texname, values.alpha_texopt);
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
    const tinyobj::material_t& values = mtl.values;
    const bool hasRoughnessMap = mtl.states("map_Pr");
    const bool hasMetalnessMap = mtl.states("map_Pm");
    if (mtl.states("Pr"))
        material.perceptualRoughness = values.roughness;
    else if (hasRoughnessMap)
        material.perceptualRoughness = 1.0f;
    else if (mtl.states("Ns"))
        material.perceptualRoughness = perceptualRoughnessOf(values.shininess);
    if (mtl.states("Pm"))
        material.metallic = values.metallic;
    else if (hasMetalnessMap)
        material.metallic = 1.0f;
    if (!hasRoughnessMap && !hasMetalnessMap) return;

    TextureUse roughness;
    TextureUse metalness;
    if (hasRoughnessMap) roughness = textureUse(mtl, "map_Pr", values.roughness_texname, values.roughness_texopt);
    if (hasMetalnessMap) metalness = textureUse(mtl, "map_Pm", values.metallic_texname, values.metallic_texopt);
    TextureUse use = hasRoughnessMap ? roughness : metalness;
    if (hasRoughnessMap && hasMetalnessMap &&
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
    const tinyobj::material_t& values = mtl.values;
    if (mtl.states("Ni") && values.ior > 1.0f) material.ior = values.ior;
    if (mtl.states("illum") && values.illum == kDiffuseOnly) {
        material.specularFactor = 0.0f;
        return;
    }
    if (mtl.states("Ks")) material.specularColor = glm::min(colourOf(values.specular), glm::vec3(1.0f));
    if (mtl.states("map_Ks"))
        material.texture(TextureSlot::SpecularColor) =
            textureUse(mtl, "map_Ks", values.specular_texname, values.specular_texopt);
}

void MaterialConverter::setNormalMap(const MtlMaterial& mtl, Material& material) {
    const tinyobj::material_t& values = mtl.values;
    if (mtl.states("norm")) {
        material.texture(TextureSlot::Normal) = textureUse(mtl, "norm", values.normal_texname, values.normal_texopt);
        material.normalScale = values.normal_texopt.bump_multiplier;
    } else if (mtl.states("map_bump") || mtl.states("bump")) {
        const char* keyword = mtl.states("map_bump") ? "map_bump" : "bump";
        warn(mtl, fmt::format("the picture of {} is taken for a tangent-space normal map; if it holds heights, "
                              "convert it",
                              keyword));
        material.texture(TextureSlot::Normal) = textureUse(mtl, keyword, values.bump_texname, values.bump_texopt);
        material.normalScale = values.bump_texopt.bump_multiplier;
    }
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
        return fmt::format("{}: material '{}', a picture of {}x{} texels", mtl.file.string(), mtl.name, width, height);
    });
}

void MaterialConverter::warn(const MtlMaterial& mtl, const std::string& what) {
    scene_.warnings.push_back(fmt::format("{}: material '{}': {}", mtl.file.string(), mtl.name, what));
}

} // namespace tessera::scenes::obj
