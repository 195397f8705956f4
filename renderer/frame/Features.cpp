#include "renderer/frame/Features.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include <fmt/format.h>

namespace tessera::frame {

namespace {

std::vector<FeatureInfo> makeTable() {
    std::vector<FeatureInfo> table;
    for (const scenes::MaterialModelInfo& model : scenes::materialModels()) {
        table.push_back({featureOf(model.model), inCapitals(model.name),
                         model.isLit ? fmt::format("model {}", model.name) : "unlit surfaces",
                         fmt::format("no material is {}", model.name)});
    }
    for (const scenes::LightTypeInfo& type : scenes::lightTypes()) {
        table.push_back({featureOf(type.type), inCapitals(type.name) + "_LIGHTS", fmt::format("{} lights", type.name),
                         fmt::format("no {} light is on{}", type.name, type.hasPosition() ? " and in view" : "")});
    }
    table.push_back(
        {Feature::AttenuationLights, "ATTENUATION_LIGHTS", "A B C falloff", "no light falls off by A + B d + C d^2"});
    table.push_back({Feature::LightPictures, "LIGHT_PICTURES", "textures of lights", "no light in view has one"});
    for (const scenes::TextureSlotInfo& slot : scenes::kTextureSlots)
        table.push_back(
            {featureOf(slot.slot), inCapitals(slot.name) + "_TEXTURE", std::string(slot.what), "no material has one"});
    table.insert(
        table.end(),
        {
            {Feature::TextureTransform, "TEXTURE_TRANSFORM", "texture transforms",
             "every texture lies as its coordinates say"},
            {Feature::MixedFilters, "MIXED_FILTERS", "choice between magnifying and minifying filters",
             "no sampler takes single texels for one of them only"},
            {Feature::TexCoord1, "TEXCOORD1", "second texture coordinates", "no texture uses them"},
            {Feature::VertexColor, "VERTEX_COLOR", "vertex colours", "no mesh has them"},
            {Feature::TangentSpaceNormals, "TANGENT_SPACE_NORMALS", "tangents", "no normal map is in tangent space"},
            {Feature::ObjectSpaceNormals, "OBJECT_SPACE_NORMALS", "object-space normal maps",
             "no normal map is in object space"},
            {Feature::Emission, "EMISSION", "emission", "no material emits or is unlit"},
            {Feature::Specular, "SPECULAR", "specular colour and strength",
             "every material keeps k_s = 1 or F0 = 0.04"},
            {Feature::MaskingOptions, "MASKING_OPTIONS", "options of masking", "every material keeps masking = walter"},
            {Feature::Anisotropy, "ANISOTROPY", "anisotropy by strength", "no material has any"},
            {Feature::Clearcoat, "CLEARCOAT", "clearcoat", "no material has any"},
            {Feature::Sheen, "SHEEN", "sheen", "no material has any"},
            {Feature::Iridescence, "IRIDESCENCE", "thin films", "no material has any"},
            {Feature::Transmission, "TRANSMISSION", "transmission", "no material has any"},
            {Feature::Volume, "VOLUME", "bodies of transmitting surfaces",
             "no material that transmits has a thickness"},
            {Feature::Dispersion, "DISPERSION", "dispersion", "no body that transmits has any"},
            {Feature::Mirrors, "MIRRORS", "mirrors of the environment", "every highlight is broader than those"},
            {Feature::AlphaMask, "ALPHA_MASK", "alpha masks", "no material is alpha-masked"},
            {Feature::Blend, "BLEND", "transparent pass", "no material is alpha-blended or transmits"},
            {Feature::DoubleSided, "DOUBLE_SIDED", "two-sided normals", "no material is double-sided"},
            {Feature::Hook, "HOOK", "what a hook reads", "the scene has no hook"},
            {Feature::VaryingMaterials, "VARYING_MATERIALS", "materials that vary over a surface",
             "no texture but normal maps, no vertex colour, no anisotropy, no thin film and no hook changes one"},
            {Feature::OrthographicCamera, "ORTHOGRAPHIC_CAMERA", "parallel rays", "the camera is perspective"},
            {Feature::Environment, "ENVIRONMENT", "light of the environment", "the scene has no environment"},
            {Feature::Shadows, "SHADOWS", "shadows", "no light in view casts any"},
            {Feature::SoftShadows, "SOFT_SHADOWS", "soft shadows", "no shadow in view is soft"},
            {Feature::ShadowMaps, "SHADOW_MAPS", "shadow maps", "no shadow is looked up in a map"},
            {Feature::ShadowLift, "SHADOW_LIFT", "softened terminators",
             "no light in view casts shadows, or their terminators are exact"},
            {Feature::SubsurfaceWrap, "SUBSURFACE_WRAP", "wrapped light", "no material uses wrap"},
            {Feature::SubsurfacePassage, "SUBSURFACE_PASSAGE", "light through thin parts",
             "no material uses depth_map"},
            {Feature::SubsurfaceDiffusion, "SUBSURFACE_DIFFUSION", "light diffused over surfaces",
             "no material uses texture_space_diffusion"},
        });
    assert(table.size() == kFeatureCount);
    return table;
}

} // namespace

std::span<const FeatureInfo> featureTable() {
    static const std::vector<FeatureInfo> table = makeTable();
    return table;
}

std::string inCapitals(std::string_view name) {
    std::string capitals(name);
    for (char& c : capitals) c = c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c;
    return capitals;
}

bool FeatureSet::any(bool (*isOne)(const scenes::MaterialModelInfo&)) const {
    const std::span<const scenes::MaterialModelInfo> models = scenes::materialModels();
    return std::any_of(models.begin(), models.end(),
                       [&](const scenes::MaterialModelInfo& model) { return (*this)[model.model] && isOne(model); });
}

bool FeatureSet::any(bool (*isOne)(const scenes::LightTypeInfo&)) const {
    const std::span<const scenes::LightTypeInfo> types = scenes::lightTypes();
    return std::any_of(types.begin(), types.end(),
                       [&](const scenes::LightTypeInfo& type) { return (*this)[type.type] && isOne(type); });
}

bool FeatureSet::litFromBehind() const {
    // A clear coat has a separate normal.
    return (*this)[Feature::Clearcoat] || subsurfaceRows() ||
           any([](const scenes::MaterialModelInfo& model) { return model.isLitFromBehind; });
}

bool FeatureSet::litModels() const {
    return any([](const scenes::MaterialModelInfo& model) { return model.isLit; });
}

bool FeatureSet::glossyModels() const {
    return any([](const scenes::MaterialModelInfo& model) { return model.highlight != scenes::Highlight::None; });
}

bool FeatureSet::microsurfaces() const {
    return any([](const scenes::MaterialModelInfo& model) { return model.microsurface != scenes::Microsurface::None; });
}

bool FeatureSet::ggxModels() const {
    return any([](const scenes::MaterialModelInfo& model) {
        return model.isMicrofacet() || model.microsurface == scenes::Microsurface::MetallicRoughness;
    });
}

bool FeatureSet::tangentFrame() const {
    return (*this)[Feature::Anisotropy] ||
           any([](const scenes::MaterialModelInfo& model) { return model.anisotropy == scenes::Anisotropy::Alphas; });
}

bool FeatureSet::tangents() const {
    return (*this)[Feature::TangentSpaceNormals] || tangentFrame() || (*this)[scenes::TextureSlot::ClearcoatNormal];
}

bool FeatureSet::textures() const {
    return std::ranges::any_of(scenes::kTextureSlots,
                               [&](const scenes::TextureSlotInfo& slot) { return (*this)[slot.slot]; });
}

bool FeatureSet::texCoords() const {
    return textures() || (*this)[Feature::SubsurfaceDiffusion] || (*this)[Feature::Hook];
}

bool FeatureSet::enteringLight() const {
    return subsurfaceRows() || (*this)[Feature::SubsurfaceDiffusion];
}

bool FeatureSet::subsurfaceRows() const {
    return (*this)[Feature::SubsurfaceWrap] || (*this)[Feature::SubsurfacePassage];
}

bool FeatureSet::anyLights() const {
    return any([](const scenes::LightTypeInfo&) { return true; });
}

bool FeatureSet::placedLights() const {
    return any([](const scenes::LightTypeInfo& type) { return type.hasPosition(); });
}

bool FeatureSet::coneLights() const {
    return any([](const scenes::LightTypeInfo& type) { return type.reach == scenes::LightReach::Cone; });
}

bool FeatureSet::areaLights() const {
    return any([](const scenes::LightTypeInfo& type) { return type.isArea; });
}

bool FeatureSet::lightShapes() const {
    return (*this)[Feature::AttenuationLights] ||
           any([](const scenes::LightTypeInfo& type) { return type.hasShape(); });
}

bool FeatureSet::lightShadowTexels() const {
    return (*this)[Feature::SoftShadows] || (*this)[Feature::ShadowMaps];
}

FeatureSet allFeatures() {
    FeatureSet set;
    set.has.set();
    return set;
}

} // namespace tessera::frame
