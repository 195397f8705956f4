#pragma once
#include <bitset>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "scenes/Scene.h"

/// What a scene uses, derived once from the scene (MaterialFeatures.h). The set decides shader defines, G-buffer
/// channels and vertex streams; other features are left out, and the picture stays the same to the last bit.
namespace tessera::frame {

enum class Feature : std::uint8_t {
    FirstModel, // the features of models follow scenes::MaterialModel
    LastModel = FirstModel + scenes::kMaterialModelCount - 1,
    FirstLightType, // those of light types follow scenes::LightType
    LastLightType = FirstLightType + scenes::kLightTypeCount - 1,
    AttenuationLights,
    LightPictures, // the radiance of lights varies over their surface
    FirstTexture,  // those of textures follow scenes::TextureSlot
    LastTexture = FirstTexture + scenes::kTextureSlotCount - 1,
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
    Iridescence,  // thin films on surfaces, which change what they reflect by the angle to the viewer
    Transmission, // light passes through surfaces
    Volume,       // of which some have a body that bends and absorbs it
    Dispersion,   // of which some bend each colour by another angle
    Mirrors,      // lobes that may be narrower than those an environment is filtered by; only where one lights surfaces
    AlphaMask,
    Blend,
    DoubleSided,
    Hook,             // the scene's own GLSL may change surfaces, and reads texture coordinates
    VaryingMaterials, // values of a material change over a surface, so each pixel must hold its own
    OrthographicCamera,
    Environment, // lights surfaces; of lit pictures with lit models
    Shadows,     // of lights in view that casters may hide
    SoftShadows, // of such lights with a size
    ShadowMaps,  // the shadows are looked up in maps, not traced
    ShadowLift,  // shadow rays of smooth-shaded triangles start above the triangle; only with shadows
    SubsurfaceWrap,
    SubsurfacePassage,   // light passes through surfaces; only where some light casts shadows
    SubsurfaceDiffusion, // light has spread over surfaces before they are drawn; only of lit pictures
    Count
};
inline constexpr std::size_t kFeatureCount = static_cast<std::size_t>(Feature::Count);

/// That some surface has the model.
constexpr Feature featureOf(scenes::MaterialModel model) {
    return static_cast<Feature>(static_cast<std::size_t>(Feature::FirstModel) + static_cast<std::size_t>(model));
}

/// That some light of the type is on and may be in view.
constexpr Feature featureOf(scenes::LightType type) {
    return static_cast<Feature>(static_cast<std::size_t>(Feature::FirstLightType) + static_cast<std::size_t>(type));
}

/// That some material has a texture there.
constexpr Feature featureOf(scenes::TextureSlot slot) {
    return static_cast<Feature>(static_cast<std::size_t>(Feature::FirstTexture) + static_cast<std::size_t>(slot));
}

struct FeatureInfo {
    Feature feature;
    std::string define; ///< HAS_<define> is 0 or 1 in every shader
    std::string what;   ///< what is left out without it
    std::string absent; ///< why it is left out; of shadows leftOut() (FrameSpec.h) says more
};
std::span<const FeatureInfo> featureTable();

/// The name of a model, type or slot, as defines have it.
std::string inCapitals(std::string_view name);

struct FeatureSet {
    std::bitset<kFeatureCount> has;
    std::optional<scenes::MaterialModel> soleModel; ///< set when every surface has this model

    bool operator[](Feature feature) const { return has[static_cast<std::size_t>(feature)]; }
    bool operator[](scenes::MaterialModel model) const { return (*this)[featureOf(model)]; }
    bool operator[](scenes::LightType type) const { return (*this)[featureOf(type)]; }
    bool operator[](scenes::TextureSlot slot) const { return (*this)[featureOf(slot)]; }
    void add(Feature feature, bool present = true) {
        if (present) has.set(static_cast<std::size_t>(feature));
    }
    bool litModels() const;
    /// Whether light from behind the shading normal may change a surface.
    bool litFromBehind() const;
    bool glossyModels() const;  ///< models with a highlight
    bool microsurfaces() const; ///< models with more parameters than colours
    bool ggxModels() const;     ///< models with a GGX lobe
    bool tangentFrame() const;  ///< surfaces keep a tangent
    bool tangents() const;      ///< meshes bring tangents
    bool textures() const;
    bool texCoords() const;      ///< meshes bring texture coordinates
    bool subsurfaceRows() const; ///< surfaces of which lighting reads SubsurfaceConstants
    bool enteringLight() const;  ///< surfaces that light enters
    bool anyLights() const;
    bool placedLights() const;      ///< lights with a position
    bool coneLights() const;        ///< lights of LightReach::Cone
    bool areaLights() const;        ///< lights of a surface
    bool lightShapes() const;       ///< lights of which shaders read LightShapeTexels
    bool lightShadowTexels() const; ///< lights of which shaders read LightShadowTexels
    bool operator==(const FeatureSet&) const = default;

private:
    bool any(bool (*isOne)(const scenes::MaterialModelInfo&)) const; ///< whether one of the set's models is so
    bool any(bool (*isOne)(const scenes::LightTypeInfo&)) const;     ///< whether one of the set's light types is so
};

/// Everything there is.
FeatureSet allFeatures();

} // namespace tessera::frame
