#include "renderer/frame/PackedMaterial.h"

#include <algorithm>
#include <cmath>

#include "renderer/frame/Tangents.h"
#include "renderer/gpu/Sampler.h"
#include "scenes/InUse.h"
#include "scenes/Limits.h"
#include "scenes/Shadows.h"
#include "shaders/shared/caster_tree.h"
#include "shaders/shared/material.h"
#include "shaders/shared/models.h"

namespace tessera::frame {

namespace {

using scenes::MaterialModel;
using scenes::TextureSlot;

static_assert(scenes::kTextureSlotCount == TEXTURE_SLOT_COUNT);
static_assert(CASTER_PASSED == SUBSURFACE_MOST - 1 && CASTER_MIRRORED > CASTER_PASSED, "marks hold every row");
static_assert(scenes::kMostSubsurfaces < SUBSURFACE_MOST, "the first row is that of none");
static_assert(unsigned(scenes::Masking::Walter) == MASKING_WALTER &&
              unsigned(scenes::Masking::Directional) == MASKING_DIRECTIONAL &&
              unsigned(scenes::Masking::HalfVector) == MASKING_HALF_VECTOR);

glm::uint materialFlags(const scenes::Material& material) {
    glm::uint flags = 0;
    if (material.texture(TextureSlot::Normal).image != scenes::kNone) flags |= MATERIAL_FLAG_NORMAL_MAP;
    if (material.normalMapSpace == scenes::NormalMapSpace::Object) flags |= MATERIAL_FLAG_OBJECT_SPACE_NORMAL;
    if (material.alphaMode == scenes::AlphaMode::Mask) flags |= MATERIAL_FLAG_ALPHA_MASK;
    if (material.doubleSided) flags |= MATERIAL_FLAG_DOUBLE_SIDED;
    if (material.texture(TextureSlot::Ior).image != scenes::kNone) flags |= MATERIAL_FLAG_IOR_TEXTURE;
    if (material.texture(TextureSlot::Anisotropy).image != scenes::kNone) flags |= MATERIAL_FLAG_ANISOTROPY_TEXTURE;
    if (material.texture(TextureSlot::ClearcoatNormal).image != scenes::kNone)
        flags |= MATERIAL_FLAG_CLEARCOAT_NORMAL_MAP;
    return flags;
}

/// uvRow1[slot].w of the constants, without the part that depends on the texture's format.
int textureModes(const scenes::Sampler& sampler) {
    const bool magnifiesNearest = gpu::usesNearest(sampler.magnification);
    const bool minifiesNearest = gpu::usesNearest(sampler.minification);
    // OpenGL 4.5 core, section 8.15: with linear magnification and nearest texels of mip levels in minification,
    // magnification applies up to level of detail 0.5.
    const bool halfLevel = !magnifiesNearest && minifiesNearest && sampler.minification != scenes::Filter::Nearest;
    return int(sampler.wrapU) + 4 * int(sampler.wrapV) + (magnifiesNearest ? TEXTURE_MODE_MAGNIFIES_NEAREST : 0) +
           (minifiesNearest ? TEXTURE_MODE_MINIFIES_NEAREST : 0) + (halfLevel ? TEXTURE_MODE_HALF_LEVEL : 0);
}

/// KHR_texture_transform: offset + rotation x scale x uv, as two rows.
void packTexture(const scenes::TextureUse& use, glm::vec4& row0, glm::vec4& row1) {
    const glm::mat2 turn(linearPart(use.transform));
    const glm::vec2 offset = use.transform.offset;
    row0 = glm::vec4(turn[0].x, turn[1].x, offset.x, float(use.texCoordSet));
    row1 = glm::vec4(turn[0].y, turn[1].y, offset.y, float(textureModes(use.sampler)));
}

/// Value of `microsurface.y` of the constants.
float roughnessParameter(const scenes::Material& material) {
    float scenes::Material::*const member = scenes::infoOf(material.model).roughness;
    return member ? material.*member : 0.0f;
}

/// -1 if the matrix mirrors, else 1.
float sideOf(const glm::dmat2& turn) {
    return glm::determinant(turn) < 0.0 ? -1.0f : 1.0f;
}

glm::vec4 packAnisotropy(const scenes::Material& material) {
    const glm::dmat2 turn = tangentsFromTexture(material, TextureSlot::Anisotropy);
    const bool hasAlphas = scenes::infoOf(material.model).anisotropy == scenes::Anisotropy::Alphas;
    const double rotation = hasAlphas ? 0.0 : double(material.anisotropyRotationRadians);
    const glm::vec2 axis(turn * glm::dvec2(std::cos(rotation), std::sin(rotation)));
    return {hasAlphas ? material.alphaY : material.anisotropyStrength, axis, sideOf(turn)};
}

glm::vec4 packClearcoatTurn(const scenes::Material& material) {
    const glm::dmat2 turn = tangentsFromTexture(material, TextureSlot::ClearcoatNormal);
    return {glm::vec2(turn[0]), sideOf(turn), 0.0f};
}

/// Beer's law: natural logarithm of the transmittance over the thickness, at most 0. It fits single precision for any
/// thickness, and keeps its digits if nearly all light is transmitted. Source: KHR_materials_volume, "Attenuation".
glm::vec3 logarithmLeftByBody(const scenes::Material& material) {
    glm::vec3 logarithm(0.0f);
    if (!(material.thicknessMetres > 0.0f) || !(material.attenuationDistanceMetres > 0.0f)) return logarithm;
    const double distances = double(material.thicknessMetres) / double(material.attenuationDistanceMetres);
    constexpr double kLeast = -1e30; // fits single precision; the logarithm of black is unbounded
    for (int c = 0; c < 3; ++c) {
        const auto color = double(material.attenuationColor[c]);
        logarithm[c] = float(color > 0.0 ? std::max(std::log(color) * distances, kLeast) : kLeast);
    }
    return logarithm;
}

/// Half of (n_F - n_C) / (n_d - 1), the inverse of the Abbe number, which is 20 over the dispersion. Source:
/// KHR_materials_dispersion.
float halfSpread(const scenes::Material& material) {
    constexpr double kAbbeNumberAtOne = 20.0;
    return scenes::disperses(material) ? float(0.5 * double(material.dispersion) / kAbbeNumberAtOne) : 0.0f;
}

/// Half the smallest side of the box around all surfaces with the material.
double bodyRadiusMetres(const scenes::Scene& scene, int material) {
    const std::vector<glm::dmat4> worldFromNode = scenes::worldFromNodes(scene);
    scenes::Box3 boxWS;
    for (std::size_t node = 0; node < scene.nodes.size(); ++node)
        for (const scenes::MeshInstance& instance : scene.nodes[node].instances) {
            if (instance.material != material) continue;
            const scenes::Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            for (const std::uint32_t index : mesh.indices)
                boxWS.extend(glm::dvec3(worldFromNode[node] * glm::dvec4(mesh.positionsOS[index], 1.0)));
        }
    const glm::dvec3 size = boxWS.max - boxWS.min;
    return 0.5 * std::min({size.x, size.y, size.z});
}

} // namespace

glm::dmat2 linearPart(const scenes::TextureTransform& transform) {
    const double c = std::cos(double(transform.rotationRadians)), s = std::sin(double(transform.rotationRadians));
    const glm::dvec2 scale(transform.scale);
    return {c * scale.x, -s * scale.x, s * scale.y, c * scale.y};
}

PackedSubsurfaces packSubsurfaces(const scenes::Scene& scene, scenes::SubsurfaceRequest request) {
    const std::vector<std::size_t> none(scene.materials.size(), 0);
    PackedSubsurfaces packed{{{}}, none, none};
    const std::vector<bool> inUse = scenes::inUse(scene).materials;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const scenes::Subsurface& subsurface = scene.materials[i].subsurface;
        const scenes::SubsurfaceMethodInfo& method = infoOf(scenes::subsurfaceOf(scene.materials[i], request));
        // The path length inside is measured by rays through casters.
        const bool passes = method.passes && scenes::castsShadow(scene.materials[i]);
        if (!inUse[i] || !(method.wraps || passes)) continue;
        packed.rowOf[i] = packed.rows.size();
        shared::SubsurfaceConstants& row = packed.rows.emplace_back();
        if (method.wraps) {
            const double radius = subsurface.bodyRadiusMetres > 0.0f ? double(subsurface.bodyRadiusMetres)
                                                                     : bodyRadiusMetres(scene, int(i));
            row.wrap = glm::vec4(subsurface.wrap * subsurface.wrapTint, float(radius));
        }
        if (passes) {
            packed.passed[i] = packed.rowOf[i];
            const double millimetres = 1e3 * double(subsurface.scaleMetres); // per metre of the scene
            row.absorption = glm::vec4(millimetres * glm::dvec3(subsurface.absorptionPerMillimetre), 1.0f);
        }
    }
    return packed;
}

shared::MaterialConstants packMaterial(const scenes::Material& material, std::size_t subsurfaceRow) {
    shared::MaterialConstants packed{};
    packed.baseColor = material.baseColor;
    packed.emissive = glm::vec4(material.emissive, material.alphaCutoff);
    packed.microsurface =
        glm::vec4(material.metallic, roughnessParameter(material), material.ior, material.normalScale);
    packed.specular = glm::vec4(material.specularColor, material.specularFactor);
    const double contrast = (double(material.ior) - 1.0) / (double(material.ior) + 1.0);
    packed.mixed = glm::vec4(float(contrast * contrast), float(subsurfaceRow), material.subsurface.preScatterShare,
                             material.occlusionStrength);
    packed.anisotropy = packAnisotropy(material);
    packed.clearcoat =
        glm::vec4(material.clearcoat, material.clearcoatPerceptualRoughness, material.clearcoatNormalScale, 0.0f);
    packed.sheen = glm::vec4(material.sheenColor, material.sheenPerceptualRoughness);
    packed.kind = glm::uvec4(glm::uint(material.model), materialFlags(material), glm::uint(material.masking), 0u);
    for (std::size_t slot = 0; slot < scenes::kTextureSlotCount; ++slot) {
        packTexture(material.textures[slot], packed.uvRow0[slot], packed.uvRow1[slot]);
    }
    packed.clearcoatTurn = packClearcoatTurn(material);
    packed.transmission =
        glm::vec4(scenes::isTransmissive(material) ? material.transmission : 0.0f,
                  material.alphaMode == scenes::AlphaMode::Blend ? 1.0f : 0.0f, material.thicknessMetres, 0.0f);
    packed.attenuation = glm::vec4(logarithmLeftByBody(material), halfSpread(material));
    constexpr double kMicrometresPerNanometre = 1e-3;
    packed.film = glm::vec4(scenes::isIridescent(material) ? material.iridescence : 0.0f, material.iridescenceIor,
                            float(kMicrometresPerNanometre * double(material.iridescenceThicknessNm)),
                            float(kMicrometresPerNanometre * double(material.iridescenceLeastThicknessNm)));
    return packed;
}

} // namespace tessera::frame
