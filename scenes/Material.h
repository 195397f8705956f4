#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>

#include <glm/glm.hpp>

#include "scenes/Fields.h"
#include "scenes/Subsurface.h"
#include "scenes/Texture.h"

/// Material data, with a table of its members and one of its models. All code that handles models or their parameters
/// uses these tables: scene files, checks, fingerprints, the viewer, the shaders' defines, the G-buffer's channels.
namespace tessera::scenes {

/// The models of the shading specification; materialModels() lists their parameters.
enum class MaterialModel : std::uint8_t {
    SingleColor,           ///< the colour itself, unlit
    Lambert,               ///< k_d max(0, n.l), no 1/pi
    BlinnPhong,            ///< k_d max(0, n.l) + k_s (n.h)^p
    Microfacet,            ///< k_d plus k_s F D G / 4, exact dielectric Fresnel
    MicrofacetAnisotropic, ///< the same with alpha_x along the tangent and alpha_y along the bitangent
    MetallicRoughness,     ///< glTF 2.0 appendix B
    Count
};

/// The masking-shadowing term G of the microfacet models.
enum class Masking : std::uint8_t {
    Walter,      ///< by the angle to the normal; anisotropic: alpha along the microfacet normal (Walter 2007)
    Directional, ///< anisotropic models only: alpha along the direction itself (Heitz 2014)
    HalfVector,  ///< by the angle to the half vector; gains energy
    Count
};

enum class AlphaMode : std::uint8_t { Opaque, Mask, Blend };
enum class NormalMapSpace : std::uint8_t { Tangent, Object };

/// How tangents are derived for meshes without any.
enum class TangentMethod : std::uint8_t {
    MikkTSpace, ///< as in bakers, recommended by glTF: weighted by angle, split where the texture is mirrored
    Lengyel     ///< summed over each vertex's triangles, as taught in courses (Lengyel 2001)
};

struct Material {
    std::string name;
    MaterialModel model = MaterialModel::MetallicRoughness;
    glm::vec4 baseColor{1.0f};         ///< base colour, k_d or the colour itself, linear; w is opacity
    glm::vec3 emissive{0.0f};          ///< radiance, linear, emissive strength multiplied in
    float metallic = 1.0f;             ///< 0..1, metallic_roughness only
    float perceptualRoughness = 1.0f;  ///< 0..1, metallic_roughness only; alpha is its square
    float alpha = 0.5f;                ///< GGX alpha of microfacet, alpha_x of microfacet_anisotropic, used as it is
    float alphaY = 0.5f;               ///< GGX alpha along the bitangent, microfacet_anisotropic only
    Masking masking = Masking::Walter; ///< microfacet models only
    float exponent = 32.0f;            ///< p of blinn_phong
    float ior = 1.5f;                  ///< index of refraction n2/n1
    float specularFactor = 1.0f;       ///< strength of the dielectric specular lobe (KHR_materials_specular)
    glm::vec3 specularColor{1.0f};     ///< k_s, or the tint of the dielectric F0 (KHR_materials_specular)
    /// KHR_materials_anisotropy, _clearcoat and _sheen, metallic_roughness only.
    float anisotropyStrength = 0.0f;           ///< 0..1
    float anisotropyRotationRadians = 0.0f;    ///< counter-clockwise from the tangent
    float clearcoat = 0.0f;                    ///< 0..1, the coat's factor
    float clearcoatPerceptualRoughness = 0.0f; ///< 0..1
    float clearcoatNormalScale = 1.0f;
    glm::vec3 sheenColor{0.0f};            ///< 0..1
    float sheenPerceptualRoughness = 0.0f; ///< 0..1
    /// KHR_materials_iridescence, metallic_roughness only: a thin film on the surface (docs/iridescence.md).
    float iridescence = 0.0f;                   ///< 0..1, weight of the film
    float iridescenceIor = 1.3f;                ///< at least 1
    float iridescenceThicknessNm = 400.0f;      ///< nanometres; 0: no film
    float iridescenceLeastThicknessNm = 100.0f; ///< nanometres, where its texture is 0; may be the larger one
    /// KHR_materials_transmission, _volume and _dispersion, metallic_roughness only (docs/glass.md).
    float transmission = 0.0f;              ///< 0..1, transmitted fraction of the light that enters
    float thicknessMetres = 0.0f;           ///< of the body below the surface; 0: thin-walled, without refraction
    glm::vec3 attenuationColor{1.0f};       ///< 0..1, colour of white light after the distance
    float attenuationDistanceMetres = 0.0f; ///< 0: no absorption
    float dispersion = 0.0f;                ///< 20 / Abbe number of the body; 0: no dispersion
    float normalScale = 1.0f;               ///< scales x and y of a tangent-space normal texel
    float occlusionStrength = 1.0f;         ///< 0..1, strength of the occlusion texture
    NormalMapSpace normalMapSpace = NormalMapSpace::Tangent;
    TangentMethod tangents = TangentMethod::MikkTSpace;
    AlphaMode alphaMode = AlphaMode::Opaque;
    float alphaCutoff = 0.5f; ///< Mask: a fragment stays when opacity >= cutoff
    bool doubleSided = false;
    bool castsShadow = true; ///< from both sides; transparent surfaces cast none (scenes/Shadows.h)
    Subsurface subsurface;   ///< lit models only
    std::array<TextureUse, kTextureSlotCount> textures;

    TextureUse& texture(TextureSlot slot) { return textures[static_cast<std::size_t>(slot)]; }
    constexpr const TextureUse& texture(TextureSlot slot) const { return textures[static_cast<std::size_t>(slot)]; }
    bool operator==(const Material&) const = default;
};

// ---- Members -------------------------------------------------------------------------------------------------------

// Above any real surface, and low enough that products of these stay within fp32.
inline constexpr double kMostColor = 1e6;
inline constexpr double kMostEmission = 1e30;
inline constexpr double kMostRoughness = 1e6;
inline constexpr double kMostIor = 1e6;

/// All members but `textures`, in order.
inline constexpr std::tuple kMaterialFields{
    Field{"name", &Material::name},
    Field{"model", &Material::model},
    Field{"baseColor", &Material::baseColor, "the base colour", 0.0, kMostColor},
    Field{"emissive", &Material::emissive, "the emission", 0.0, kMostEmission},
    Field{"metallic", &Material::metallic, "metalness", 0.0, 1.0},
    Field{"perceptualRoughness", &Material::perceptualRoughness, "roughness", 0.0, 1.0},
    Field{"alpha", &Material::alpha, "alpha", 0.0, kMostRoughness},
    Field{"alphaY", &Material::alphaY, "alphaY", 0.0, kMostRoughness},
    Field{"masking", &Material::masking},
    Field{"exponent", &Material::exponent, "the exponent", 0.0, kAnyNumber},
    Field{"ior", &Material::ior, "the index of refraction", 0.0, kMostIor},
    Field{"specularFactor", &Material::specularFactor, "the specular factor", 0.0, 1.0},
    Field{"specularColor", &Material::specularColor, "the specular colour", 0.0, kMostColor},
    Field{"anisotropyStrength", &Material::anisotropyStrength, "the anisotropy", 0.0, 1.0},
    Field{"anisotropyRotationRadians", &Material::anisotropyRotationRadians, "the anisotropy's rotation", -kAnyNumber,
          kAnyNumber},
    Field{"clearcoat", &Material::clearcoat, "the clearcoat", 0.0, 1.0},
    Field{"clearcoatPerceptualRoughness", &Material::clearcoatPerceptualRoughness, "the clearcoat's roughness", 0.0,
          1.0},
    Field{"clearcoatNormalScale", &Material::clearcoatNormalScale, "the clearcoat normal map's scale", -kAnyNumber,
          kAnyNumber},
    Field{"sheenColor", &Material::sheenColor, "the sheen's colour", 0.0, 1.0},
    Field{"sheenPerceptualRoughness", &Material::sheenPerceptualRoughness, "the sheen's roughness", 0.0, 1.0},
    Field{"iridescence", &Material::iridescence, "the iridescence", 0.0, 1.0},
    Field{"iridescenceIor", &Material::iridescenceIor, "the film's index of refraction", 1.0, kMostIor},
    Field{"iridescenceThicknessNm", &Material::iridescenceThicknessNm, "the film's thickness", 0.0, kAnyNumber},
    Field{"iridescenceLeastThicknessNm", &Material::iridescenceLeastThicknessNm, "the film's least thickness", 0.0,
          kAnyNumber},
    Field{"transmission", &Material::transmission, "the transmission", 0.0, 1.0},
    Field{"thicknessMetres", &Material::thicknessMetres, "the thickness", 0.0, kAnyNumber},
    Field{"attenuationColor", &Material::attenuationColor, "the attenuation's colour", 0.0, 1.0},
    Field{"attenuationDistanceMetres", &Material::attenuationDistanceMetres, "the attenuation's distance", 0.0,
          kAnyNumber},
    Field{"dispersion", &Material::dispersion, "the dispersion", 0.0, kAnyNumber},
    Field{"normalScale", &Material::normalScale, "the normal map's scale", -kAnyNumber, kAnyNumber},
    Field{"occlusionStrength", &Material::occlusionStrength, "the occlusion's strength", 0.0, 1.0},
    Field{"normalMapSpace", &Material::normalMapSpace},
    Field{"tangents", &Material::tangents},
    Field{"alphaMode", &Material::alphaMode},
    Field{"alphaCutoff", &Material::alphaCutoff, "the alpha cutoff", -kAnyNumber, kAnyNumber},
    Field{"doubleSided", &Material::doubleSided},
    Field{"castsShadow", &Material::castsShadow},
    Field{"subsurface", &Material::subsurface},
};

static_assert(std::tuple_size_v<decltype(kMaterialFields)> + 1 == detail::memberCount<Material>(),
              "kMaterialFields lacks a member of Material");

// ---- Models --------------------------------------------------------------------------------------------------------

/// A parameter of a model besides its colour.
struct MaterialParameter {
    enum class Kind : std::uint8_t {
        Number,
        Ior,          ///< above 0
        IorOrPerfect, ///< at least 1, or 0, which reflects everything (KHR_materials_ior)
        Color,
        Masking
    };
    Kind kind;
    const char* key;   ///< of scene files
    const char* label; ///< in the viewer
    std::variant<float Material::*, glm::vec3 Material::*, Masking Material::*> member;
    TextureSlot slot = TextureSlot::Count; ///< slot of the texture that scales it; Count: none
    /// Bounds and number format of the viewer's slider.
    float leastShown = 0.0f;
    float mostShown = 1.0f;
    const char* format = "%.3f";
};

/// Colour of a model's highlight.
enum class Highlight : std::uint8_t {
    None,
    Tinted,    ///< k_s
    Dielectric ///< F0 of the index of refraction, tinted and scaled (KHR_materials_specular)
};

/// Contents of the G-buffer's microsurface channel, besides the model's index. A new kind needs code where that channel
/// is written and read (shaders/lib/gbuffer/gbuffer_channels.glsl); a new model of an existing kind does not.
enum class Microsurface : std::uint8_t {
    None,
    Parameter,        ///< the model's single parameter >= 0, MaterialModelInfo::roughness
    Dielectric,       ///< GGX alpha, index of refraction and masking-shadowing option
    MetallicRoughness ///< GGX alpha, F90 and metallic
};

/// Source of a separate alpha along the bitangent.
enum class Anisotropy : std::uint8_t {
    None,
    Alphas,  ///< alphaY, scaled by R of TextureSlot::Anisotropy; supports Masking::Directional
    Strength ///< anisotropyStrength, with the texture's direction and B (KHR_materials_anisotropy)
};

struct MaterialModelInfo {
    MaterialModel model;
    std::string_view name; ///< in scene files; in capitals in shaders: MODEL_<NAME> is its index, HAS_<NAME> 0 or 1
    bool isLit;
    const char* colorKey; ///< the key of Material::baseColor in scene files
    Highlight highlight = Highlight::None;
    Microsurface microsurface = Microsurface::None;
    float Material::*roughness = nullptr; ///< the member scaled by G of TextureSlot::MetallicRoughness
    std::span<const MaterialParameter> parameters{};
    Anisotropy anisotropy = Anisotropy::None;
    bool hasLayers = false;       ///< emission, and scenes/MaterialLayers.h: clearcoat, sheen, film, transmission
    bool isLitFromBehind = false; ///< affected by light from behind the shading normal, e.g. translucency

    constexpr bool isMicrofacet() const { return microsurface == Microsurface::Dielectric; }
};

namespace detail {
using Kind = MaterialParameter::Kind;
inline constexpr MaterialParameter kSpecularColor{Kind::Color, "k_s", "k_s", &Material::specularColor,
                                                  TextureSlot::SpecularColor};
inline constexpr MaterialParameter kIor{Kind::Ior, "ior", "Index n", &Material::ior, TextureSlot::Ior, 1.0f, 4.0f};
inline constexpr MaterialParameter kMasking{Kind::Masking, "masking", "Masking", &Material::masking};
constexpr MaterialParameter alpha(const char* key, const char* label, float Material::*member, TextureSlot slot) {
    return {Kind::Number, key, label, member, slot, 1e-3f, 1.0f, "%.4f"}; // 1e-3: lower bound of the shading formulas
}

inline constexpr MaterialParameter kBlinnPhong[] = {
    kSpecularColor,
    {Kind::Number, "exponent", "Exponent", &Material::exponent, TextureSlot::MetallicRoughness, 1.0f, 1000.0f, "%.1f"}};
inline constexpr MaterialParameter kMicrofacet[] = {
    kSpecularColor, alpha("alpha", "Alpha", &Material::alpha, TextureSlot::MetallicRoughness), kIor, kMasking};
inline constexpr MaterialParameter kMicrofacetAnisotropic[] = {
    kSpecularColor, alpha("alphaX", "Alpha x", &Material::alpha, TextureSlot::MetallicRoughness),
    alpha("alphaY", "Alpha y", &Material::alphaY, TextureSlot::Anisotropy), kIor, kMasking};
inline constexpr MaterialParameter kMetallicRoughness[] = {
    {Kind::Number, "metallic", "Metallic", &Material::metallic},
    {Kind::Number, "perceptualRoughness", "Roughness", &Material::perceptualRoughness},
    {Kind::IorOrPerfect, "ior", "Index n", &Material::ior, TextureSlot::Ior, 1.0f, 4.0f},
    {Kind::Number, "specularFactor", "Specular", &Material::specularFactor, TextureSlot::SpecularFactor},
    {Kind::Color, "specularColor", "F0 tint", &Material::specularColor, TextureSlot::SpecularColor}};

using Info = MaterialModelInfo;
inline constexpr std::array kMaterialModels{
    Info{MaterialModel::SingleColor, "single_color", false, "color"},
    Info{MaterialModel::Lambert, "lambert", true, "k_d"},
    Info{MaterialModel::BlinnPhong, "blinn_phong", true, "k_d", Highlight::Tinted, Microsurface::Parameter,
         &Material::exponent, kBlinnPhong},
    Info{MaterialModel::Microfacet, "microfacet", true, "k_d", Highlight::Tinted, Microsurface::Dielectric,
         &Material::alpha, kMicrofacet},
    Info{MaterialModel::MicrofacetAnisotropic, "microfacet_anisotropic", true, "k_d", Highlight::Tinted,
         Microsurface::Dielectric, &Material::alpha, kMicrofacetAnisotropic, Anisotropy::Alphas},
    Info{MaterialModel::MetallicRoughness, "metallic_roughness", true, "baseColor", Highlight::Dielectric,
         Microsurface::MetallicRoughness, &Material::perceptualRoughness, kMetallicRoughness, Anisotropy::Strength,
         true},
};
consteval bool isInOrder() {
    for (std::size_t i = 0; i < kMaterialModels.size(); ++i)
        if (kMaterialModels[i].model != MaterialModel(i)) return false;
    return kMaterialModels.size() == std::size_t(MaterialModel::Count);
}
static_assert(isInOrder(), "the table of models follows the enumeration");
} // namespace detail

inline constexpr std::size_t kMaterialModelCount = detail::kMaterialModels.size();

/// The single table of models, indexed by MaterialModel.
constexpr std::span<const MaterialModelInfo> materialModels() {
    return detail::kMaterialModels;
}
constexpr const MaterialModelInfo& infoOf(MaterialModel model) {
    return detail::kMaterialModels[std::size_t(model)];
}

/// Whether a model supports a masking-shadowing option. Models without masking ignore it and accept all.
constexpr bool supportsMasking(MaterialModel model, Masking masking) {
    const MaterialModelInfo& info = infoOf(model);
    return masking != Masking::Directional || !info.isMicrofacet() || info.anisotropy == Anisotropy::Alphas;
}

/// Maximum thickness of the film in nanometres, including its texture's range.
constexpr float mostFilmThicknessNm(const Material& material) {
    const bool isTextured = material.texture(TextureSlot::IridescenceThickness).image != kNone;
    const float least = material.iridescenceLeastThicknessNm;
    return isTextured && least > material.iridescenceThicknessNm ? least : material.iridescenceThicknessNm;
}

/// Whether surfaces may have an iridescent film. Texels are not inspected, here and below.
constexpr bool isIridescent(const Material& material) {
    return infoOf(material.model).hasLayers && material.iridescence > 0.0f && mostFilmThicknessNm(material) > 0.0f;
}

/// Whether surfaces may transmit light.
constexpr bool isTransmissive(const Material& material) {
    return infoOf(material.model).hasLayers && material.transmission > 0.0f;
}

/// Whether the material has a body that refracts transmitted light.
constexpr bool hasBody(const Material& material) {
    return isTransmissive(material) && material.thicknessMetres > 0.0f;
}

/// Whether the body refracts each colour by another angle.
constexpr bool disperses(const Material& material) {
    return hasBody(material) && material.dispersion > 0.0f;
}

/// Whether surfaces are blended over those behind them, from far to near.
constexpr bool isTransparent(const Material& material) {
    return material.alphaMode == AlphaMode::Blend || isTransmissive(material);
}

/// Effective subsurface method of a material under a request. None if the method would have no effect, and for unlit,
/// transmissive or iridescent materials.
inline SubsurfaceMethod subsurfaceOf(const Material& material, SubsurfaceRequest request) {
    const Subsurface& subsurface = material.subsurface;
    if (!infoOf(material.model).isLit || subsurface.method == SubsurfaceMethod::None || isTransmissive(material) ||
        isIridescent(material))
        return SubsurfaceMethod::None;
    const SubsurfaceMethod method = request.value_or(subsurface.method);
    const bool wraps = subsurface.wrap > 0.0f && subsurface.wrapTint != glm::vec3(0.0f);
    return infoOf(method).wraps && !wraps ? SubsurfaceMethod::None : method;
}

/// Whether the specular lobe depends on the tangent.
constexpr bool isAnisotropic(const Material& material) {
    const Anisotropy anisotropy = infoOf(material.model).anisotropy;
    return anisotropy == Anisotropy::Alphas ||
           (anisotropy == Anisotropy::Strength && material.anisotropyStrength > 0.0f);
}

} // namespace tessera::scenes
