#include "renderer/frame/MaterialFeatures.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "renderer/gpu/Sampler.h"
#include "scenes/InUse.h"
#include "shaders/shared/environment.h"
#include "shaders/shared/material.h"
#include "shaders/shared/models.h"
#include "shaders/shared/refraction.h"

namespace tessera::frame {

namespace {

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

/// Whether pixels of a material may differ in more than directions: by any texture other than a normal map, even if its
/// model ignores it, by anisotropy, whose alphas rotate with the tangent, and by a thin film.
bool varies(const scenes::Material& material) {
    for (const scenes::TextureSlotInfo& slot : scenes::kTextureSlots)
        if (!slot.isNormal && material.texture(slot.slot).image != scenes::kNone) return true;
    return scenes::isAnisotropic(material) || scenes::isIridescent(material);
}

/// Below this alpha, environment lighting needs more than the filtered map (shaders/lib/reflectance/mirrors.glsl). The
/// margin is 10 %, since the layout `slim` stores such alphas in steps of 8 %.
constexpr double kSharpAlpha = 1.1 * ENVIRONMENT_LEAST_ALPHA;

/// Half of the least alpha: below it, rounding in shaders never yields more than ALPHA_MIN.
constexpr double kSurelyMirrorAlpha = 0.5 * ALPHA_MIN;

/// Whether a highlight or a transmission lobe of the material may be sharper. Textures may contain any texel.
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
    if (scenes::isTransmissive(material) &&
        (isTextured(TextureSlot::Ior) ||
         squared(roughness) * double(shared::leastPassingScale(material.ior)) < kSharpAlpha))
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

/// The material as shaders read it: without an environment, nothing reads occlusion.
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
                gpu::usesNearest(use.sampler.magnification) != gpu::usesNearest(use.sampler.minification));
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
    // With diffusion, transmitted light is already part of the diffused irradiance.
    set.add(Feature::SubsurfacePassage, method.passes && !method.diffuses);
    if (!method.diffuses) return;
    set.add(Feature::SubsurfaceDiffusion);
    // Surfaces store diffused light as emission, and their F0 as that of a dielectric: takeDiffusedLight() of
    // shaders/lib/raster/diffused_light.glsl.
    set.add(Feature::Emission);
    set.add(Feature::VaryingMaterials);
    set.add(Feature::Specular, model.microsurface == scenes::Microsurface::MetallicRoughness &&
                                   (material.metallic != 0.0f ||
                                    material.texture(scenes::TextureSlot::MetallicRoughness).image != scenes::kNone));
}

} // namespace

bool mayScatter(const scenes::Material& material) {
    if (!scenes::isTransmissive(material)) return false;
    const auto isTextured = [&](scenes::TextureSlot slot) { return material.texture(slot).image != scenes::kNone; };
    if (isTextured(scenes::TextureSlot::MetallicRoughness) || isTextured(scenes::TextureSlot::Ior)) return true;
    const auto roughness = double(material.perceptualRoughness);
    return material.ior != 1.0f && roughness * roughness > kSurelyMirrorAlpha;
}

bool mayLookBehindGlass(const scenes::Scene& scene) {
    return std::ranges::any_of(scenes::materialsInUse(scene), [](const scenes::Material* material) {
        return scenes::hasBody(*material) || mayScatter(*material);
    });
}

bool mayPassByLobe(const scenes::Material& material) {
    if (!scenes::isTransmissive(material)) return false;
    const auto roughness = double(material.perceptualRoughness);
    return roughness * roughness > kSurelyMirrorAlpha || scenes::isAnisotropic(material) ||
           material.texture(scenes::TextureSlot::MetallicRoughness).image != scenes::kNone;
}

bool canMask(const scenes::Material& material) {
    return scenes::infoOf(material.model).isMicrofacet();
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
    // If materials exceed their table, pixels store them like varying ones.
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
    // Alpha masks of shadow casters.
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

FeatureSet surfaceFeatures(const scenes::Scene& scene, bool prune, scenes::SubsurfaceRequest subsurface) {
    return prune ? materialFeatures(scene, subsurface) : allFeatures();
}

} // namespace tessera::frame
