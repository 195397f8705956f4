#pragma once
#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

/// How a material uses pictures.
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

/// Applied to a texture coordinate as offset + rotation(scale * uv), after KHR_texture_transform (v points down, the
/// origin is the picture's top-left corner, a positive angle turns the coordinates counter-clockwise in that
/// convention).
struct TextureTransform {
    glm::vec2 offset{0.0f};
    glm::vec2 scale{1.0f};
    float rotationRadians = 0.0f;
    bool operator==(const TextureTransform&) const = default;
};

/// A texture as a material uses it; `image` is kNone when the slot is empty, and then the factor alone counts.
struct TextureUse {
    int image = kNone;
    Sampler sampler;
    int texCoordSet = 0; ///< 0 or 1
    TextureTransform transform;
    bool operator==(const TextureUse&) const = default;
};

/// Where a material may carry a texture. Every value is factor x texel; the channels used and the transfer function:
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
    Clearcoat,          ///< R share of the coat (linear)
    ClearcoatRoughness, ///< G perceptual roughness of the coat (linear)
    ClearcoatNormal,    ///< RGB normal of the coat, tangent space (linear)
    SheenColor,         ///< RGB (sRGB)
    SheenRoughness,     ///< A perceptual roughness of the sheen (linear)
    Count
};
inline constexpr std::size_t kTextureSlotCount = static_cast<std::size_t>(TextureSlot::Count);

} // namespace tessera::scenes
