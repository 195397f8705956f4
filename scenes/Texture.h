#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <glm/glm.hpp>

#include "base/EnumTable.h"

/// Use of images by materials: samplers, transforms and slots.
namespace tessera::scenes {

inline constexpr int kNone = -1;

enum class Wrap : std::uint8_t { Repeat, ClampToEdge, MirroredRepeat };
enum class Filter : std::uint8_t {
    Nearest,
    Linear,
    NearestMipmapNearest,
    LinearMipmapNearest,
    NearestMipmapLinear,
    LinearMipmapLinear
};

struct Sampler {
    Filter magnification = Filter::Linear;
    Filter minification = Filter::LinearMipmapLinear;
    Wrap wrapU = Wrap::Repeat;
    Wrap wrapV = Wrap::Repeat;
    bool operator==(const Sampler&) const = default;
};

/// Maximum of texture coordinates and of animated offsets and scales: products stay finite in fp32.
inline constexpr double kMostTextureNumber = double(std::uint64_t{1} << 55);

/// Applied to a texture coordinate as offset + rotation(scale * uv), after KHR_texture_transform (v points down, the
/// origin is the image's top-left corner, a positive angle turns the coordinates counter-clockwise in that convention).
struct TextureTransform {
    glm::vec2 offset{0.0f};
    glm::vec2 scale{1.0f};
    float rotationRadians = 0.0f;
    bool operator==(const TextureTransform&) const = default;
};

/// A material's use of a texture; `image` is kNone if the slot is empty, and then the factor alone counts.
struct TextureUse {
    int image = kNone;
    Sampler sampler;
    int texCoordSet = 0; ///< 0 or 1
    TextureTransform transform;
    bool operator==(const TextureUse&) const = default;
};

/// Texture slots of a material, with the channels used and their transfer function. Every value is factor x texel.
/// Slots are in order of importance: if a shader stage supports too few textures, the last ones are dropped first
/// (leaveOutTextures() of renderer/frame/TextureRoom.h).
enum class TextureSlot : std::uint8_t {
    BaseColor,          ///< RGB base colour, k_d or the unlit colour (sRGB); A opacity
    Normal,             ///< RGB normal, tangent or object space (linear)
    MetallicRoughness,  ///< G roughness (perceptual for metallic_roughness, alpha or alpha_x for the microfacet models,
                        ///< the exponent for blinn_phong), B metalness (linear)
    Emissive,           ///< RGB (sRGB)
    SpecularFactor,     ///< A strength of the dielectric specular lobe (linear)
    SpecularColor,      ///< RGB k_s, or the tint of the dielectric F0 (sRGB)
    Ior,                ///< R index of refraction (linear)
    Anisotropy,         ///< RG direction in tangent space as 2 x texel - 1, B strength (metallic_roughness);
                        ///< R alpha_y (microfacet_anisotropic) (linear)
    Clearcoat,          ///< R weight of the coat (linear)
    ClearcoatRoughness, ///< G perceptual roughness of the coat (linear)
    ClearcoatNormal,    ///< RGB normal of the coat, tangent space (linear)
    SheenColor,         ///< RGB (sRGB)
    SheenRoughness,     ///< A perceptual roughness of the sheen (linear)
    Occlusion,          ///< R unoccluded fraction of the environment's light (linear)
    Transmission,       ///< R transmitted fraction of the light that enters (linear)
    Thickness,          ///< G thickness of the body, as a fraction of the material's (linear)
    Iridescence,        ///< R weight of the film (linear)
    IridescenceThickness, ///< G thickness of the film, from the material's least at 0 to its thickness at 1 (linear)
    Count
};
inline constexpr std::size_t kTextureSlotCount = static_cast<std::size_t>(TextureSlot::Count);

struct TextureSlotInfo {
    TextureSlot slot;
    std::string_view name; ///< in capitals in shaders: TEXTURE_SLOT_<NAME> is its index, HAS_<NAME>_TEXTURE 0 or 1
    std::string_view what; ///< in plans
    bool isSrgb = false;   ///< its texels are sRGB-encoded colours
    bool isNormal = false; ///< it only changes a normal
};

inline constexpr std::array kTextureSlots{
    TextureSlotInfo{TextureSlot::BaseColor, "base_color", "base-colour texture", true},
    TextureSlotInfo{TextureSlot::Normal, "normal", "normal maps", false, true},
    TextureSlotInfo{TextureSlot::MetallicRoughness, "metallic_roughness", "roughness texture"},
    TextureSlotInfo{TextureSlot::Emissive, "emissive", "emissive texture", true},
    TextureSlotInfo{TextureSlot::SpecularFactor, "specular_factor", "specular-strength texture"},
    TextureSlotInfo{TextureSlot::SpecularColor, "specular_color", "specular-colour texture", true},
    TextureSlotInfo{TextureSlot::Ior, "ior", "index-of-refraction texture"},
    TextureSlotInfo{TextureSlot::Anisotropy, "anisotropy", "anisotropy texture"},
    TextureSlotInfo{TextureSlot::Clearcoat, "clearcoat", "clearcoat texture"},
    TextureSlotInfo{TextureSlot::ClearcoatRoughness, "clearcoat_roughness", "clearcoat-roughness texture"},
    TextureSlotInfo{TextureSlot::ClearcoatNormal, "clearcoat_normal", "clearcoat normal maps", false, true},
    TextureSlotInfo{TextureSlot::SheenColor, "sheen_color", "sheen-colour texture", true},
    TextureSlotInfo{TextureSlot::SheenRoughness, "sheen_roughness", "sheen-roughness texture"},
    TextureSlotInfo{TextureSlot::Occlusion, "occlusion", "occlusion texture"},
    TextureSlotInfo{TextureSlot::Transmission, "transmission", "transmission texture"},
    TextureSlotInfo{TextureSlot::Thickness, "thickness", "thickness texture"},
    TextureSlotInfo{TextureSlot::Iridescence, "iridescence", "iridescence texture"},
    TextureSlotInfo{TextureSlot::IridescenceThickness, "iridescence_thickness", "film-thickness texture"},
};
static_assert(isInOrder(kTextureSlots, &TextureSlotInfo::slot, kTextureSlotCount));
constexpr const TextureSlotInfo& infoOf(TextureSlot slot) {
    return kTextureSlots[std::size_t(slot)];
}

} // namespace tessera::scenes
