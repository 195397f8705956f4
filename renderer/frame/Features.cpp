#include "renderer/frame/Features.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "renderer/gpu/Sampler.h"
#include "scenes/InUse.h"
#include "shaders/shared/environment.h"
#include "shaders/shared/material.h"
#include "shaders/shared/models.h"

namespace tessera::frame {

namespace {

std::string inCapitals(std::string_view name) {
    std::string capitals(name);
    for (char& c : capitals) c = c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c;
    return capitals;
}

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
            {Feature::Volume, "VOLUME", "bodies of what transmits", "no material that transmits has a thickness"},
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
            {Feature::SubsurfaceWrap, "SUBSURFACE_WRAP", "wrapped light", "no material uses wrap"},
            {Feature::SubsurfacePassage, "SUBSURFACE_PASSAGE", "light through thin parts",
             "no material uses depth_map"},
            {Feature::SubsurfaceDiffusion, "SUBSURFACE_DIFFUSION", "light spread over surfaces",
             "no material uses texture_space_diffusion"},
        });
    assert(table.size() == kFeatureCount);
    return table;
}

bool changesSpecular(const scenes::Material& material) {
    const bool tinted = material.specularColor != glm::vec3(1.0f) ||
                        material.texture(scenes::TextureSlot::SpecularColor).image != scenes::kNone;
    const scenes::Highlight highlight = scenes::infoOf(material.model).highlight;
    if (highlight == scenes::Highlight::Tinted) return tinted;
    return highlight == scenes::Highlight::Dielectric &&
           (tinted || scenes::isIridescent(material) || material.ior != 1.5f ||
            material.texture(scenes::TextureSlot::Ior).image != scenes::kNone || material.specularFactor != 1.0f ||
            material.texture(scenes::TextureSlot::SpecularFactor).image != scenes::kNone);
}

/// Whether pixels of a material may differ in more than directions: by any texture that is no normal map, whether its
/// model uses it or not, by anisotropy, which turns its alphas with the tangent, and by a film.
bool varies(const scenes::Material& material) {
    for (const scenes::TextureSlotInfo& slot : scenes::kTextureSlots)
        if (!slot.isNormal && material.texture(slot.slot).image != scenes::kNone) return true;
    return scenes::isAnisotropic(material) || scenes::isIridescent(material);
}

/// Below it the light of an environment is not its filtered map's alone (shaders/lib/reflectance/mirrors.glsl). A tenth
/// more, since the layout `slim` keeps alphas there in steps of 8 %.
constexpr double kSharpAlpha = 1.1 * ENVIRONMENT_LEAST_ALPHA;

/// By how much light that passes is spread less than light that is reflected: factor of alpha.
/// setPassing() of shaders/lib/material/material.glsl.
double passingScale(float ior) {
    const double scale = ior > 0.0f ? std::clamp(2.0 * double(ior) - 2.0, 0.0, 1.0) : 1.0;
    return scale * scale;
}

/// Whether a highlight of the material may be sharper, or light that passes through it. Textures may have any texel.
bool mayMirror(const scenes::Material& material) {
    using scenes::Microsurface, scenes::TextureSlot;
    const auto isTextured = [&](TextureSlot slot) { return material.texture(slot).image != scenes::kNone; };
    const auto squared = [](float roughness) { return double(roughness) * double(roughness); };
    const scenes::MaterialModelInfo& model = scenes::infoOf(material.model);
    if (model.hasLayers && material.clearcoat > 0.0f &&
        (squared(material.clearcoatPerceptualRoughness) < kSharpAlpha || isTextured(TextureSlot::ClearcoatRoughness)))
        return true;
    if (model.highlight == scenes::Highlight::None || !model.roughness) return false;
    if (isTextured(TextureSlot::MetallicRoughness)) return true;
    if (model.anisotropy == scenes::Anisotropy::Alphas &&
        (double(material.alphaY) < kSharpAlpha || isTextured(TextureSlot::Anisotropy)))
        return true;
    const float roughness = material.*model.roughness;
    if (scenes::hasBody(material) &&
        (isTextured(TextureSlot::Ior) || squared(roughness) * passingScale(material.ior) < kSharpAlpha))
        return true;
    switch (model.microsurface) {
    case Microsurface::None:
        break;
    case Microsurface::Parameter: // lobeAlpha() of shaders/lib/reflectance/lobes.glsl
        return std::sqrt(2.0 / (double(roughness) + 2.0)) < kSharpAlpha;
    case Microsurface::Dielectric:
        return double(roughness) < kSharpAlpha;
    case Microsurface::MetallicRoughness:
        return squared(roughness) < kSharpAlpha;
    }
    return false;
}

/// The material in a scene, which may have no environment: then nothing reads occlusion.
scenes::Material readMaterial(const scenes::Scene& scene, scenes::Material material) {
    if (!scene.environment) material.texture(scenes::TextureSlot::Occlusion) = {};
    return material;
}

void addMaterial(FeatureSet& set, const scenes::Material& material, scenes::SubsurfaceRequest subsurface) {
    const scenes::MaterialModelInfo& model = scenes::infoOf(material.model);
    set.add(featureOf(material.model));
    set.add(Feature::MaskingOptions, canMask(material) && material.masking != scenes::Masking::Walter);
    set.add(Feature::Anisotropy,
            model.anisotropy == scenes::Anisotropy::Strength && material.anisotropyStrength > 0.0f);
    set.add(Feature::Clearcoat, model.hasLayers && material.clearcoat > 0.0f);
    set.add(Feature::Sheen, model.hasLayers && material.sheenColor != glm::vec3(0.0f));
    set.add(Feature::Iridescence, scenes::isIridescent(material));
    set.add(Feature::Transmission, scenes::isTransmissive(material));
    set.add(Feature::Volume, scenes::hasBody(material));
    set.add(Feature::Dispersion, scenes::disperses(material));
    set.add(Feature::Mirrors, mayMirror(material));
    for (std::size_t slot = 0; slot < scenes::kTextureSlotCount; ++slot) {
        const scenes::TextureUse& use = material.textures[slot];
        if (use.image == scenes::kNone) continue;
        set.add(featureOf(scenes::TextureSlot(slot)));
        set.add(Feature::TexCoord1, use.texCoordSet == 1);
        set.add(Feature::MixedFilters,
                gpu::takesNearest(use.sampler.magnification) != gpu::takesNearest(use.sampler.minification));
        set.add(Feature::TextureTransform, use.transform != scenes::TextureTransform{});
    }
    const bool normalMap = material.texture(scenes::TextureSlot::Normal).image != scenes::kNone;
    const bool objectSpace = material.normalMapSpace == scenes::NormalMapSpace::Object;
    set.add(Feature::TangentSpaceNormals, normalMap && !objectSpace);
    set.add(Feature::ObjectSpaceNormals, normalMap && objectSpace);
    set.add(Feature::Emission, material.emissive != glm::vec3(0.0f) || !model.isLit);
    set.add(Feature::Specular, changesSpecular(material));
    set.add(Feature::AlphaMask, material.alphaMode == scenes::AlphaMode::Mask);
    set.add(Feature::Blend, scenes::isTransparent(material));
    set.add(Feature::DoubleSided, material.doubleSided);
    set.add(Feature::VaryingMaterials, varies(material));
    const scenes::SubsurfaceMethodInfo& method = infoOf(scenes::subsurfaceOf(material, subsurface));
    set.add(Feature::SubsurfaceWrap, method.wraps);
    // Light that spreads has passed through before.
    set.add(Feature::SubsurfacePassage, method.passes && !method.spreads);
    if (!method.spreads) return;
    set.add(Feature::SubsurfaceDiffusion);
    // Surfaces hold the light that has spread over them as emission, and their own F0 as that of a dielectric:
    // takeSpreadLight() of shaders/lib/raster/spread_light.glsl.
    set.add(Feature::Emission);
    set.add(Feature::VaryingMaterials);
    set.add(Feature::Specular, model.microsurface == scenes::Microsurface::MetallicRoughness &&
                                   (material.metallic != 0.0f ||
                                    material.texture(scenes::TextureSlot::MetallicRoughness).image != scenes::kNone));
}

constexpr bool isMicrofacet(const scenes::MaterialModelInfo& model) {
    return model.microsurface == scenes::Microsurface::Dielectric;
}

/// They stand side by side, as the G-buffer numbers their maskings one after the other.
constexpr scenes::MaterialModel kFirstMicrofacet = std::ranges::find_if(scenes::materialModels(), isMicrofacet)->model;
static_assert(std::ranges::is_partitioned(scenes::materialModels().subspan(std::size_t(kFirstMicrofacet)),
                                          isMicrofacet));

// What a surface is of which nothing is known (shaders/lib/surface/surface.glsl).
static_assert(!scenes::materialModels().front().isLit);

/// The number of a model in a shader.
std::string numberOf(scenes::MaterialModel model) {
    return fmt::format("{}u", static_cast<int>(model));
}

void addModels(const FeatureSet& features, Defines& defines) {
    using scenes::Anisotropy, scenes::Highlight, scenes::Microsurface, scenes::MaterialModelInfo;
    for (const MaterialModelInfo& model : scenes::materialModels())
        defines.emplace_back("MODEL_" + inCapitals(model.name), numberOf(model.model));
    defines.emplace_back("MODEL_COUNT", fmt::format("{}u", scenes::kMaterialModelCount));
    defines.emplace_back("MODEL_FIRST_MICROFACET", numberOf(kFirstMicrofacet));
    if (features.soleModel) defines.emplace_back("SOLE_MODEL", numberOf(*features.soleModel));

    const auto addList = [&](const char* name, const char* each, const char* between, const char* none,
                             const auto& isOne) {
        std::vector<std::string> list;
        for (const MaterialModelInfo& model : scenes::materialModels())
            if (features[model.model] && isOne(model))
                list.push_back(fmt::format(fmt::runtime(each), int(model.model)));
        defines.emplace_back(name, list.empty() ? none : fmt::format("{}", fmt::join(list, between)));
    };
    const auto isLit = [](const MaterialModelInfo& model) { return model.isLit; };
    addList("LIT_MODELS", "{}u", ", ", "", isLit);
    // Whether a surface's model is one of those; false is known before the shader runs.
    const auto addQuestion = [&](const char* name, const auto& isOne) {
        addList(name, "(model) == {}u", " || ", "false", isOne);
        defines.back().second = "(" + defines.back().second + ")";
    };
    addQuestion("IS_UNLIT(model)", [](const MaterialModelInfo& model) { return !model.isLit; });
    addQuestion("IS_GLOSSY(model)", [](const MaterialModelInfo& model) { return model.highlight != Highlight::None; });
    addQuestion("HAS_DIELECTRIC_F0(model)",
                [](const MaterialModelInfo& model) { return model.highlight == Highlight::Dielectric; });
    addQuestion("HAS_PARAMETER(model)",
                [](const MaterialModelInfo& model) { return model.microsurface == Microsurface::Parameter; });
    addQuestion("IS_MICROFACET(model)", isMicrofacet);
    addQuestion("HAS_METALLIC(model)",
                [](const MaterialModelInfo& model) { return model.microsurface == Microsurface::MetallicRoughness; });
    addQuestion("HAS_TWO_ALPHAS(model)",
                [](const MaterialModelInfo& model) { return model.anisotropy == Anisotropy::Alphas; });
    addQuestion("HAS_ANISOTROPY_STRENGTH(model)",
                [](const MaterialModelInfo& model) { return model.anisotropy == Anisotropy::Strength; });
    addQuestion("HAS_LAYERS(model)", [](const MaterialModelInfo& model) { return model.hasLayers; });
}

void addLightTypes(const FeatureSet& features, Defines& defines) {
    std::vector<std::string> cones, areas;
    for (const scenes::LightTypeInfo& type : scenes::lightTypes()) {
        defines.emplace_back("LIGHT_" + inCapitals(type.name), fmt::format("{}", int(type.type)));
        if (!features[type.type]) continue;
        const std::string isType = fmt::format("(type) == {}", int(type.type));
        if (type.reach == scenes::LightReach::Cone) cones.push_back(isType);
        if (type.isArea) areas.push_back(isType);
    }
    // Whether a light's type is one of those.
    const auto any = [](const std::vector<std::string>& types) {
        return types.empty() ? "(false)" : fmt::format("({})", fmt::join(types, " || "));
    };
    defines.emplace_back("IS_CONE_LIGHT(type)", any(cones));
    defines.emplace_back("IS_AREA_LIGHT(type)", any(areas));
}

} // namespace

std::span<const FeatureInfo> featureTable() {
    static const std::vector<FeatureInfo> table = makeTable();
    return table;
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
    // A clear coat has a normal of its own.
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
        return isMicrofacet(model) || model.microsurface == scenes::Microsurface::MetallicRoughness;
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

bool mayBlurBehind(const scenes::Material& material) {
    // Half of the least alpha, so that rounding in shaders never finds more.
    constexpr double kSharpest = 0.5 * ALPHA_MIN;
    if (!scenes::hasBody(material)) return false;
    const auto isTextured = [&](scenes::TextureSlot slot) { return material.texture(slot).image != scenes::kNone; };
    if (isTextured(scenes::TextureSlot::MetallicRoughness) || isTextured(scenes::TextureSlot::Ior)) return true;
    const auto roughness = double(material.perceptualRoughness);
    return roughness * roughness * passingScale(material.ior) > kSharpest;
}

bool canMask(const scenes::Material& material) {
    return isMicrofacet(scenes::infoOf(material.model));
}

FeatureSet materialFeatures(const scenes::Scene& scene, scenes::SubsurfaceRequest subsurface) {
    FeatureSet set;
    std::optional<scenes::MaterialModel> model;
    bool several = false;
    const std::vector<const scenes::Material*> materials = scenes::materialsInUse(scene);
    for (const scenes::Material* material : materials) {
        addMaterial(set, readMaterial(scene, *material), subsurface);
        several = several || (model && *model != material->model);
        model = material->model;
    }
    for (const scenes::Mesh* mesh : scenes::meshesInUse(scene)) set.add(Feature::VertexColor, !mesh->colors.empty());
    if (!several) set.soleModel = model;
    if (scene.hook && scene.hook->changesSurfaces) {
        set.add(Feature::Hook);
        set.add(Feature::Emission);
        set.add(Feature::VaryingMaterials);
        set.add(Feature::Mirrors, set.glossyModels());
    }
    // More than fit their table are stored in the pixels as those that vary.
    set.add(Feature::VaryingMaterials, set[Feature::VertexColor] || materials.size() > MATERIAL_TABLE_MOST);
    return set;
}

scenes::Material enteredMaterial(const scenes::Material& material) {
    scenes::Material entered;
    entered.model = scenes::MaterialModel::Lambert;
    entered.baseColor = material.baseColor;
    entered.normalScale = material.normalScale;
    entered.occlusionStrength = material.occlusionStrength;
    entered.normalMapSpace = material.normalMapSpace;
    entered.doubleSided = material.doubleSided;
    using scenes::TextureSlot;
    for (const TextureSlot slot : {TextureSlot::BaseColor, TextureSlot::Normal, TextureSlot::Occlusion})
        entered.texture(slot) = material.texture(slot);
    entered.subsurface = material.subsurface;
    entered.subsurface.method = scenes::SubsurfaceMethod::None;
    return entered;
}

FeatureSet enteringFeatures(const scenes::Scene& scene, int material, int mesh) {
    const scenes::Material entered = enteredMaterial(scene.materials[std::size_t(material)]);
    FeatureSet set;
    addMaterial(set, readMaterial(scene, entered), {});
    set.add(Feature::SubsurfacePassage);
    set.soleModel = entered.model;
    set.add(Feature::VertexColor, !scene.meshes[std::size_t(mesh)].colors.empty());
    set.add(Feature::VaryingMaterials);
    set.add(Feature::Hook, scene.hook && scene.hook->changesSurfaces);
    // Holes of what stands in the light's way.
    for (const scenes::Material* other : scenes::materialsInUse(scene)) {
        if (other->alphaMode != scenes::AlphaMode::Mask) continue;
        scenes::Material masked;
        masked.model = scenes::MaterialModel::Lambert;
        masked.alphaMode = scenes::AlphaMode::Mask;
        masked.alphaCutoff = other->alphaCutoff;
        masked.texture(scenes::TextureSlot::BaseColor) = other->texture(scenes::TextureSlot::BaseColor);
        addMaterial(set, masked, {});
        for (const scenes::Mesh* caster : scenes::meshesInUse(scene))
            set.add(Feature::VertexColor, !caster->colors.empty());
    }
    return set;
}

FeatureSet allFeatures() {
    FeatureSet set;
    set.has.set();
    return set;
}

FeatureSet surfaceFeatures(const scenes::Scene& scene, bool prune, scenes::SubsurfaceRequest subsurface) {
    return prune ? materialFeatures(scene, subsurface) : allFeatures();
}

Defines featureDefines(const FeatureSet& features) {
    Defines defines;
    const auto addFlag = [&](std::string name, bool flag) { defines.emplace_back(std::move(name), flag ? "1" : "0"); };
    for (const FeatureInfo& info : featureTable()) addFlag("HAS_" + info.define, features[info.feature]);
    addFlag("HAS_LIT_MODELS", features.litModels());
    addFlag("HAS_GLOSSY_MODELS", features.glossyModels());
    addFlag("HAS_MICROSURFACES", features.microsurfaces());
    addFlag("HAS_GGX_MODELS", features.ggxModels());
    addFlag("HAS_TANGENT_FRAME", features.tangentFrame());
    addFlag("HAS_TANGENTS", features.tangents());
    addFlag("HAS_TEXTURES", features.textures());
    addFlag("HAS_TEXCOORDS", features.texCoords());
    addFlag("HAS_SUBSURFACE_ROWS", features.subsurfaceRows());
    addFlag("HAS_ENTERING_LIGHT", features.enteringLight());
    addFlag("HAS_PLACED_LIGHTS", features.placedLights());
    addFlag("HAS_CONE_LIGHTS", features.coneLights());
    addFlag("HAS_AREA_LIGHTS", features.areaLights());
    addFlag("HAS_LIGHT_SHAPES", features.lightShapes());
    addFlag("HAS_LIGHT_SHADOW_TEXELS", features.lightShadowTexels());
    for (const scenes::TextureSlotInfo& slot : scenes::kTextureSlots)
        defines.emplace_back("TEXTURE_SLOT_" + inCapitals(slot.name), fmt::format("{}", int(slot.slot)));
    addLightTypes(features, defines);
    addModels(features, defines);
    return defines;
}

} // namespace tessera::frame
