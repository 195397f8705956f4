#include "validation/reference/MaterialAt.h"

#include <algorithm>

#include "validation/reference/NormalAt.h"
#include "validation/reference/Slots.h"

namespace tessera::reference {

namespace {

using scenes::MaterialModel;
using scenes::TextureSlot;

glm::dvec4 baseColorAt(const Hit& hit, const std::vector<scenes::Image>& images) {
    const std::vector<glm::vec4>& colors = hit.object->mesh->colors;
    const glm::dvec4 vertexColor = colors.empty() ? glm::dvec4(1.0) : hit.at<glm::dvec4>(colors);
    return glm::dvec4(hit.object->material->baseColor) * texelOf(TextureSlot::BaseColor, hit, images) * vertexColor;
}

/// metallic_roughness squares its perceptual roughness; microfacet takes alpha as it is.
double alphaAt(const scenes::Material& material, double roughnessTexel) {
    const double perceptual = double(material.perceptualRoughness) * roughnessTexel;
    const double alpha = material.model == MaterialModel::MetallicRoughness ? perceptual * perceptual
                                                                            : double(material.alpha) * roughnessTexel;
    return std::max(alpha, kSmallestAlpha);
}

} // namespace

SurfacePoint surfaceAt(const Hit& hit, const std::vector<scenes::Image>& images) {
    const scenes::Material& material = *hit.object->material;
    const auto texel = [&](TextureSlot slot) { return texelOf(slot, hit, images); };
    const glm::dvec4 base = baseColorAt(hit, images);
    const glm::dvec4 roughnessMetallic = texel(TextureSlot::MetallicRoughness);
    SurfacePoint point;
    point.model = material.model;
    point.color = glm::dvec3(base);
    point.opacity = std::clamp(base.a, 0.0, 1.0);
    point.metallic = double(material.metallic) * roughnessMetallic.b;
    point.alpha = alphaAt(material, roughnessMetallic.g);
    point.ior = double(material.ior) * texel(TextureSlot::Ior).r;
    point.specularFactor = double(material.specularFactor) * texel(TextureSlot::SpecularFactor).a;
    point.specularColor = glm::dvec3(material.specularColor) * glm::dvec3(texel(TextureSlot::SpecularColor));
    point.emission = glm::dvec3(material.emissive) * glm::dvec3(texel(TextureSlot::Emissive));
    point.normal = normalAt(hit, images);
    return point;
}

double opacityAt(const Hit& hit, const std::vector<scenes::Image>& images) {
    return baseColorAt(hit, images).a;
}

} // namespace tessera::reference
