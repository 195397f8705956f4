#include "validation/reference/TangentFrame.h"

#include <cmath>

namespace tessera::reference {

using scenes::TextureSlot;

std::optional<TextureSlot> tangentSlot(const scenes::Material& material) {
    const auto hasImage = [&](TextureSlot slot) { return material.texture(slot).image != scenes::kNone; };
    if (hasImage(TextureSlot::Normal) && material.normalMapSpace == scenes::NormalMapSpace::Tangent)
        return TextureSlot::Normal;
    const scenes::MaterialModelInfo& model = scenes::infoOf(material.model);
    if (model.anisotropy == scenes::Anisotropy::Alphas) return TextureSlot::Anisotropy;
    if (model.anisotropy == scenes::Anisotropy::Strength && material.anisotropyStrength > 0.0f)
        return TextureSlot::Anisotropy;
    if (model.hasLayers && material.clearcoat > 0.0f && hasImage(TextureSlot::ClearcoatNormal))
        return TextureSlot::ClearcoatNormal;
    return std::nullopt;
}

glm::dmat2 textureFromUv(const scenes::Material& material, TextureSlot slot) {
    const scenes::TextureUse& use = material.texture(slot);
    const bool isNumber =
        slot == TextureSlot::Anisotropy && scenes::infoOf(material.model).anisotropy == scenes::Anisotropy::Alphas;
    if (use.image == scenes::kNone || isNumber) return glm::dmat2(1.0);
    const double angle = double(use.transform.rotationRadians);
    const glm::dmat2 rotation(std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle));
    return rotation * glm::dmat2(use.transform.scale.x, 0.0, 0.0, use.transform.scale.y);
}

Axis axisOf(const glm::dmat2& textureFromUv) {
    if (glm::determinant(textureFromUv) == 0.0) return {};
    const glm::dmat2 uvFromTexture = glm::inverse(textureFromUv);
    const glm::dvec2 upwards(1.0, -1.0);
    const glm::dvec2 alongU = upwards * (uvFromTexture * glm::dvec2(1.0, 0.0));
    const glm::dvec2 againstV = upwards * (uvFromTexture * glm::dvec2(0.0, -1.0));
    const double area = alongU.x * againstV.y - alongU.y * againstV.x;
    return {glm::normalize(alongU), area < 0.0 ? -1.0 : 1.0};
}

glm::dvec2 alongTangents(const scenes::Material& material, TextureSlot slot, const glm::dvec2& texel) {
    const std::optional<TextureSlot> followed = tangentSlot(material);
    if (!followed) return texel;
    const auto left = [](const glm::dvec2& v) { return glm::dvec2(-v.y, v.x); };
    const Axis own = axisOf(textureFromUv(material, slot)), frame = axisOf(textureFromUv(material, *followed));
    const glm::dvec2 onMesh = texel.x * own.alongU + texel.y * own.side * left(own.alongU);
    return {glm::dot(onMesh, frame.alongU), glm::dot(onMesh, left(frame.alongU)) * frame.side};
}

} // namespace tessera::reference
