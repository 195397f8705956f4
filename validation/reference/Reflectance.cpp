#include "validation/reference/Reflectance.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "validation/reference/Microfacet.h"

namespace tessera::reference {

namespace {

using scenes::MaterialModel;

glm::dvec3 unlit(const SurfacePoint&, const Directions&, bool) {
    return glm::dvec3(0.0);
}

/// k_d without 1/pi, as the teaching models have it.
glm::dvec3 lambert(const SurfacePoint& point, const Directions& directions, bool) {
    return point.color * directions.cosLight;
}

/// (k_d + k_s F D G / (4 n.l n.v)) n.l. Source: Cook and Torrance 1982 with the D, G and F of Walter et al. 2007.
glm::dvec3 microfacet(const SurfacePoint& point, const Directions& directions, bool specular) {
    glm::dvec3 share = point.color;
    if (specular && directions.hasLobe()) {
        const double f = fresnelDielectric(point.ior, directions.cosIncidence);
        const double d = distributionGgx(point.alpha, directions.cosHalf);
        const double g = maskingSmith(point.alpha, directions.cosLight) * maskingSmith(point.alpha, directions.cosView);
        share += point.specularColor * (f * d * g / (4.0 * directions.cosLight * directions.cosView));
    }
    return share * directions.cosLight;
}

/// glTF 2.0 appendix B, with the reflectances of KHR_materials_ior and KHR_materials_specular. The Fresnel factor needs
/// no lobe: where there is none, what it does not reflect still reaches the diffuse layer.
glm::dvec3 metallicRoughness(const SurfacePoint& point, const Directions& directions, bool specular) {
    const double contrast = (point.ior - 1.0) / (point.ior + 1.0);
    const double grazing = point.specularFactor + (1.0 - point.specularFactor) * point.metallic;
    double lobe = 0.0;
    if (specular && directions.hasLobe()) {
        lobe = distributionGgx(point.alpha, directions.cosHalf) *
               maskingCorrelated(point.alpha, directions.cosLight, directions.cosView) /
               (4.0 * directions.cosLight * directions.cosView);
    }
    glm::dvec3 share;
    for (int c = 0; c < 3; ++c) {
        const double dielectric = std::min(contrast * contrast * point.specularColor[c], 1.0) * point.specularFactor;
        const double normalIncidence = dielectric + (point.color[c] - dielectric) * point.metallic;
        const double f = fresnelSchlick(normalIncidence, grazing, directions.cosIncidence);
        share[c] = (1.0 - f) * (1.0 - point.metallic) * point.color[c] / std::numbers::pi + f * lobe;
    }
    return share * directions.cosLight;
}

constexpr Model kModels[] = {
    {MaterialModel::SingleColor, true, unlit},
    {MaterialModel::Lambert, false, lambert},
    {MaterialModel::Microfacet, false, microfacet},
    {MaterialModel::MetallicRoughness, false, metallicRoughness},
};

} // namespace

Directions::Directions(const glm::dvec3& n, const glm::dvec3& l, const glm::dvec3& v)
    : normal(n), toLight(l), toViewer(v), cosLight(glm::dot(n, l)), cosView(glm::dot(n, v)) {
    const double length = glm::length(l + v);
    if (length > 0.0) half = (l + v) / length;
    cosHalf = glm::dot(n, half);
    cosIncidence = glm::dot(l, half);
}

std::span<const Model> modelTable() {
    return kModels;
}

const Model& modelOf(MaterialModel model) {
    const auto* row = std::find_if(std::begin(kModels), std::end(kModels),
                                   [model](const Model& candidate) { return candidate.model == model; });
    if (row == std::end(kModels)) throw std::logic_error("the reference renderer's table lacks a material model");
    return *row;
}

glm::dvec3 reflected(const SurfacePoint& point, const glm::dvec3& toLight, const glm::dvec3& toViewer, bool specular) {
    const Directions directions(point.normal, toLight, toViewer);
    if (!(directions.cosLight > 0.0)) return glm::dvec3(0.0);
    return modelOf(point.model).reflected(point, directions, specular);
}

} // namespace tessera::reference
