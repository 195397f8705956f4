#pragma once
#include <bitset>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "renderer/shader/Preprocess.h"
#include "scenes/Scene.h"

/// What a scene uses, derived once from the scene. The set decides shader defines, G-buffer channels and vertex
/// streams; what is not in it is left out, and the picture stays the same to the last bit.
namespace tessera::frame {

enum class Feature : std::uint8_t {
    SingleColor,
    Lambert,
    BlinnPhong,
    Microfacet,
    MicrofacetAnisotropic,
    MetallicRoughness,
    DirectionalLights,
    PointLights,
    SpotLights,
    AttenuationLights,
    BaseColorTexture, // the texture features follow scenes::TextureSlot
    NormalTexture,
    MetallicRoughnessTexture,
    EmissiveTexture,
    SpecularFactorTexture,
    SpecularColorTexture,
    IorTexture,
    AnisotropyTexture,
    ClearcoatTexture,
    ClearcoatRoughnessTexture,
    ClearcoatNormalTexture,
    SheenColorTexture,
    SheenRoughnessTexture,
    TextureTransform,
    MixedFilters, // samplers that take single texels on one side of the choice between magnifying and minifying
    TexCoord1,
    VertexColor,
    TangentSpaceNormals,
    ObjectSpaceNormals,
    Emission,
    Specular,
    MaskingOptions,
    Anisotropy,
    Clearcoat,
    Sheen,
    AlphaMask,
    Blend,
    DoubleSided,
    VaryingMaterials, // values of a material change over a surface, so each pixel must hold its own
    OrthographicCamera,
    Count
};
inline constexpr std::size_t kFeatureCount = static_cast<std::size_t>(Feature::Count);

struct FeatureInfo {
    Feature feature;
    std::string_view define; ///< HAS_<define> is 0 or 1 in every shader
    std::string_view what;   ///< what is left out without it
    std::string_view absent; ///< why it is left out
};
std::span<const FeatureInfo> featureTable();

using shader::Defines;

struct FeatureSet {
    std::bitset<kFeatureCount> has;
    std::optional<scenes::MaterialModel> soleModel; ///< set when every surface has this model

    bool operator[](Feature feature) const { return has[static_cast<std::size_t>(feature)]; }
    void add(Feature feature, bool present = true) {
        if (present) has.set(static_cast<std::size_t>(feature));
    }
    bool litModels() const;
    bool glossyModels() const; ///< models with a highlight
    bool tangentFrame() const; ///< surfaces keep a tangent
    bool tangents() const;     ///< meshes bring tangents
    bool textures() const;
    bool operator==(const FeatureSet&) const = default;
};

/// Whether it has one of the two microfacet models, which alone have options of masking.
bool isMicrofacet(const scenes::Material& material);

/// The set of what materials in use need; lights are added by packLights, which knows which of them can be seen, and
/// the camera by makeFrameSpec.
FeatureSet materialFeatures(const scenes::Scene& scene);

/// Everything there is (prune = off).
FeatureSet allFeatures();

/// HAS_* of every feature as 0 or 1, HAS_LIT_MODELS, HAS_TEXTURES, and SOLE_MODEL where there is one.
Defines featureDefines(const FeatureSet& features);

} // namespace tessera::frame
