#include "validation/reference/MaterialAt.h"

#include <algorithm>
#include <cmath>

#include "scenes/Shadows.h"
#include "validation/reference/NormalAt.h"
#include "validation/reference/Slots.h"
#include "validation/reference/TangentFrame.h"

namespace tessera::reference {

namespace {

using scenes::TextureSlot;

glm::dvec4 baseColorAt(const Hit& hit, const Textures& textures) {
    const std::vector<glm::vec4>& colors = hit.object->mesh->colors;
    const glm::dvec4 vertexColor = colors.empty() ? glm::dvec4(1.0) : hit.at<glm::dvec4>(colors);
    return glm::dvec4(hit.object->material->baseColor) * texelOf(TextureSlot::BaseColor, hit, textures) * vertexColor;
}

double squaredRoughness(double perceptual) {
    return std::max(perceptual * perceptual, kSmallestAlpha);
}

/// Anisotropy by KHR_materials_anisotropy, or by the second alpha of models that have two.
void setDirection(const Hit& hit, const Textures& textures, SurfacePoint& point) {
    const scenes::Material& material = *hit.object->material;
    const glm::dvec4 texel = texelOf(TextureSlot::Anisotropy, hit, textures);
    point.alphaAcross = point.alpha;
    glm::dvec2 direction(1.0, 0.0);
    const scenes::Anisotropy anisotropy = scenes::infoOf(material.model).anisotropy;
    if (anisotropy == scenes::Anisotropy::Alphas) {
        point.alphaAcross = std::max(double(material.alphaY) * texel.r, kSmallestAlpha);
    } else if (anisotropy == scenes::Anisotropy::Strength && material.anisotropyStrength > 0.0f) {
        const double strength = double(material.anisotropyStrength) * texel.b;
        point.alpha = std::lerp(point.alpha, 1.0, strength * strength);
        // By the product's definition a texel shorter than a hundredth has no direction.
        const glm::dvec2 stored = 2.0 * glm::dvec2(texel) - 1.0;
        const bool textured = material.texture(TextureSlot::Anisotropy).image != scenes::kNone;
        if (textured && glm::dot(stored, stored) > 1e-4) direction = stored;
        const double turn = double(material.anisotropyRotationRadians);
        direction = {std::cos(turn) * direction.x - std::sin(turn) * direction.y,
                     std::sin(turn) * direction.x + std::cos(turn) * direction.y};
    } else {
        return;
    }
    point.tangent = tangentAt(hit, point.normal, alongTangents(material, TextureSlot::Anisotropy, direction));
}

/// KHR_materials_iridescence. A thickness of 0 means no film.
void setFilm(const Hit& hit, const Textures& textures, SurfacePoint& point) {
    const scenes::Material& material = *hit.object->material;
    point.filmIor = double(material.iridescenceIor);
    point.filmThicknessNm = double(material.iridescenceThicknessNm);
    if (material.texture(TextureSlot::IridescenceThickness).image != scenes::kNone)
        point.filmThicknessNm = std::lerp(double(material.iridescenceLeastThicknessNm), point.filmThicknessNm,
                                          texelOf(TextureSlot::IridescenceThickness, hit, textures).g);
    if (point.filmThicknessNm > 0.0)
        point.film = double(material.iridescence) * texelOf(TextureSlot::Iridescence, hit, textures).r;
}

void setLayers(const Hit& hit, const Textures& textures, SurfacePoint& point) {
    const scenes::Material& material = *hit.object->material;
    const auto texel = [&](TextureSlot slot) { return texelOf(slot, hit, textures); };
    if (!scenes::infoOf(material.model).hasLayers) return;
    point.coat = double(material.clearcoat) * texel(TextureSlot::Clearcoat).r;
    point.coatAlpha =
        squaredRoughness(double(material.clearcoatPerceptualRoughness) * texel(TextureSlot::ClearcoatRoughness).g);
    setFilm(hit, textures, point);
    if (point.coat > 0.0) point.coatNormal = coatNormalAt(hit, textures);
    point.sheenColor = glm::dvec3(material.sheenColor) * glm::dvec3(texel(TextureSlot::SheenColor));
    point.sheenAlpha =
        squaredRoughness(double(material.sheenPerceptualRoughness) * texel(TextureSlot::SheenRoughness).a);
}

void setTransmission(const Hit& hit, const Textures& textures, SurfacePoint& point) {
    const scenes::Material& material = *hit.object->material;
    if (!scenes::isTransmissive(material)) return;
    if (material.alphaMode != scenes::AlphaMode::Blend) point.opacity = 1.0;
    point.transmission = double(material.transmission) * texelOf(TextureSlot::Transmission, hit, textures).r;
    point.hasBody = scenes::hasBody(material); // also where its texture is 0: it bends light there too
    const double thickness = double(material.thicknessMetres) * texelOf(TextureSlot::Thickness, hit, textures).g;
    const double distance = double(material.attenuationDistanceMetres);
    point.bodyMetres = thickness;
    if (point.hasBody) point.dispersion = double(material.dispersion);
    if (point.hasBody && distance > 0.0)
        for (int c = 0; c < 3; ++c) point.bodyPerMetre[c] = -std::log(double(material.attenuationColor[c])) / distance;
    point.passingAlpha = point.ior == 1.0 ? kSmallestAlpha : squaredRoughness(point.roughness);
}

} // namespace

SurfacePoint surfaceAt(const Hit& hit, const Textures& textures,
                       const std::function<void(SurfacePoint& point)>& change) {
    const scenes::Material& material = *hit.object->material;
    const auto texel = [&](TextureSlot slot) { return texelOf(slot, hit, textures); };
    const glm::dvec4 base = baseColorAt(hit, textures);
    const glm::dvec4 roughnessMetallic = texel(TextureSlot::MetallicRoughness);
    SurfacePoint point;
    point.model = material.model;
    point.color = glm::dvec3(base);
    point.opacity = std::clamp(base.a, 0.0, 1.0);
    point.openness =
        std::clamp(std::lerp(1.0, texel(TextureSlot::Occlusion).r, double(material.occlusionStrength)), 0.0, 1.0);
    point.metallic = double(material.metallic) * roughnessMetallic.b;
    const scenes::MaterialModelInfo& model = scenes::infoOf(material.model);
    if (model.roughness) {
        point.roughness = double(material.*model.roughness) * roughnessMetallic.g;
        // metallic_roughness squares its perceptual roughness; microfacet takes alpha as it is.
        point.alpha = model.microsurface == scenes::Microsurface::MetallicRoughness
                          ? squaredRoughness(point.roughness)
                          : std::max(point.roughness, kSmallestAlpha);
    }
    point.ior = double(material.ior) * texel(TextureSlot::Ior).r;
    point.specularFactor = double(material.specularFactor) * texel(TextureSlot::SpecularFactor).a;
    point.specularColor = glm::dvec3(material.specularColor) * glm::dvec3(texel(TextureSlot::SpecularColor));
    point.emission = glm::dvec3(material.emissive) * glm::dvec3(texel(TextureSlot::Emissive));
    point.masking = material.masking;
    point.normal = normalAt(hit, textures);
    if (change) change(point);
    setDirection(hit, textures, point);
    setLayers(hit, textures, point);
    setTransmission(hit, textures, point);
    const scenes::SubsurfaceMethodInfo& method = infoOf(hit.object->subsurface);
    if (method.wraps) {
        point.wrap = double(material.subsurface.wrap) * glm::dvec3(material.subsurface.wrapTint);
        point.bodyRadiusMetres = hit.object->bodyRadiusMetres;
    }
    point.diffuses = method.diffuses;
    // The path length inside can only be measured among shadow casters.
    point.passes = method.passes && scenes::castsShadow(material);
    if (point.passes) {
        const double perMillimetre = 1000.0 * double(material.subsurface.scaleMetres);
        point.absorptionPerMetre = perMillimetre * glm::dvec3(material.subsurface.absorptionPerMillimetre);
    }
    return point;
}

double opacityAt(const Hit& hit, const Textures& textures) {
    return baseColorAt(hit, textures).a;
}

} // namespace tessera::reference
