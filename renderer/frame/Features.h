#pragma once
#include <bitset>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "scenes/Scene.h"

/// The features that a scene uses, derived once from the scene (MaterialFeatures.h). They determine shader defines,
/// G-buffer channels and vertex streams. Omitting the other features leaves the image bit-identical.
namespace tessera::frame {

enum class Feature : std::uint8_t {
    FirstModel, // the features of models follow scenes::MaterialModel
    LastModel = FirstModel + scenes::kMaterialModelCount - 1,
    FirstLightType, // those of light types follow scenes::LightType
    LastLightType = FirstLightType + scenes::kLightTypeCount - 1,
    AttenuationLights,
    LightPictures, // textured area lights
    FirstTexture,  // those of textures follow scenes::TextureSlot
    LastTexture = FirstTexture + scenes::kTextureSlotCount - 1,
    TextureTransform,
    MixedFilters, // samplers with nearest filtering for only one of magnification and minification
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
    Iridescence,  // thin films on surfaces, whose reflectance depends on the view angle
    Transmission, // surfaces transmit light
    Volume,       // some of them enclose a volume that refracts and absorbs light
    Dispersion,   // some volumes refract each colour by a different angle
    Mirrors,      // lobes that may be narrower than the filtered environment's; only with environment lighting
    AlphaMask,
    Blend,
    DoubleSided,
    Hook,             // the scene's own GLSL may change surfaces, and reads texture coordinates
    VaryingMaterials, // material values vary over a surface, so each pixel stores them
    OrthographicCamera,
    Environment, // lights surfaces; only lit views with lit models
    Shadows,     // lights in view that casters may occlude
    SoftShadows, // such lights with a size
    ShadowMaps,  // the shadows are looked up in maps, not traced
    ShadowLift,  // shadow rays of smooth-shaded triangles start above the triangle; only with shadows
    SubsurfaceWrap,
    SubsurfacePassage,   // light transmitted through thin parts; only if a light casts shadows
    SubsurfaceDiffusion, // irradiance is diffused before surfaces are drawn; only lit views
    Count
};
inline constexpr std::size_t kFeatureCount = static_cast<std::size_t>(Feature::Count);

/// Some surface has the model.
constexpr Feature featureOf(scenes::MaterialModel model) {
    return static_cast<Feature>(static_cast<std::size_t>(Feature::FirstModel) + static_cast<std::size_t>(model));
}

/// Some light of the type is on and may be in view.
constexpr Feature featureOf(scenes::LightType type) {
    return static_cast<Feature>(static_cast<std::size_t>(Feature::FirstLightType) + static_cast<std::size_t>(type));
}

/// Some material has a texture in the slot.
constexpr Feature featureOf(scenes::TextureSlot slot) {
    return static_cast<Feature>(static_cast<std::size_t>(Feature::FirstTexture) + static_cast<std::size_t>(slot));
}

struct FeatureInfo {
    Feature feature;
    std::string define; ///< HAS_<define> is 0 or 1 in every shader
    std::string what;   ///< what is left out without it
    std::string absent; ///< why it is left out; leftOut() (FrameSpec.h) is more specific about shadows
};
std::span<const FeatureInfo> featureTable();

/// The upper-case name of a model, type or slot, for defines.
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
    bool tangentFrame() const;  ///< surfaces store a tangent
    bool tangents() const;      ///< meshes provide tangents
    bool textures() const;
    bool texCoords() const;      ///< meshes provide texture coordinates
    bool subsurfaceRows() const; ///< surfaces whose SubsurfaceConstants lighting reads
    bool enteringLight() const;  ///< surfaces with subsurface scattering
    bool anyLights() const;
    bool placedLights() const;      ///< lights with a position
    bool coneLights() const;        ///< lights of LightReach::Cone
    bool areaLights() const;        ///< lights with an emitting surface
    bool lightShapes() const;       ///< lights whose LightShapeTexels shaders read
    bool lightShadowTexels() const; ///< lights whose LightShadowTexels shaders read
    bool operator==(const FeatureSet&) const = default;

private:
    bool any(bool (*isOne)(const scenes::MaterialModelInfo&)) const; ///< whether any model of the set qualifies
    bool any(bool (*isOne)(const scenes::LightTypeInfo&)) const;     ///< whether any light type of the set qualifies
};

/// All features.
FeatureSet allFeatures();

} // namespace tessera::frame
