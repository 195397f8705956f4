#include "validation/reference/Reflectance.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "validation/reference/EvenLight.h"
#include "validation/reference/Film.h"
#include "validation/reference/Lobes.h"
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

/// k_d n.l + k_s (n.h)^p. Source: Blinn 1977, "Models of Light Reflection for Computer Synthesized Pictures".
glm::dvec3 blinnPhong(const SurfacePoint& point, const Directions& directions, bool specular) {
    glm::dvec3 brdfCosine = point.color * directions.cosLight;
    if (specular && directions.hasLobe())
        brdfCosine += point.specularColor * std::pow(directions.cosHalf, point.roughness);
    return brdfCosine;
}

/// Transforms to the frame of tangent, bitangent and normal. For isotropic lobes the azimuth is arbitrary.
glm::dvec3 local(const SurfacePoint& point, const glm::dvec3& direction) {
    const double cosine = glm::dot(point.normal, direction);
    if (point.tangent == glm::dvec3(0.0)) return {std::sqrt(std::max(1.0 - cosine * cosine, 0.0)), 0.0, cosine};
    return {glm::dot(point.tangent, direction), glm::dot(glm::cross(point.normal, point.tangent), direction), cosine};
}

/// D G / (4 n.l n.v) by the point's masking-shadowing option; `alpha` along tangent and bitangent.
double microfacetLobe(const SurfacePoint& point, const Directions& directions, const glm::dvec2& alpha) {
    const glm::dvec3 half = local(point, directions.half);
    const double d = alpha.x == alpha.y ? distributionGgx(alpha.x, directions.cosHalf) : distributionGgx(alpha, half);
    const double along = alphaAlong(alpha, half);
    // n.v is at least 1e-6, as in the source of this option, a course handout.
    if (point.masking == scenes::Masking::HalfVector) {
        const double g1 = maskingSmith(along, directions.cosIncidence);
        return d * g1 * g1 / (4.0 * directions.cosLight * std::max(directions.cosView, 1e-6));
    }
    const bool directional = point.masking == scenes::Masking::Directional;
    const double alphaLight = directional ? alphaAlong(alpha, local(point, directions.toLight)) : along;
    const double alphaView = directional ? alphaAlong(alpha, local(point, directions.toViewer)) : along;
    const double g = maskingSmith(alphaLight, directions.cosLight) * maskingSmith(alphaView, directions.cosView);
    return d * g / (4.0 * directions.cosLight * directions.cosView);
}

/// (k_d + k_s F D G / (4 n.l n.v)) n.l. Source: Cook and Torrance 1982 with the D, G and F of Walter et al. 2007.
glm::dvec3 microfacet(const SurfacePoint& point, const Directions& directions, bool specular) {
    glm::dvec3 brdf = point.color;
    if (specular && point.reflectsLobe && directions.hasLobe()) {
        const double f = fresnelDielectric(point.ior, directions.cosIncidence);
        brdf += point.specularColor * (f * microfacetLobe(point, directions, glm::dvec2(point.alpha)));
    }
    return brdf * directions.cosLight;
}

/// The same with a lobe of two alphas.
glm::dvec3 microfacetAnisotropic(const SurfacePoint& point, const Directions& directions, bool specular) {
    glm::dvec3 brdf = point.color;
    if (specular && point.reflectsLobe && directions.hasLobe()) {
        const double f = fresnelDielectric(point.ior, directions.cosIncidence);
        brdf += point.specularColor * (f * microfacetLobe(point, directions, {point.alpha, point.alphaAcross}));
    }
    return brdf * directions.cosLight;
}

/// D G / (4 n.l n.v) of metallic_roughness, by KHR_materials_anisotropy where the lobe is anisotropic.
double glossyLobe(const SurfacePoint& point, const Directions& directions) {
    const glm::dvec2 alpha(point.alpha, point.alphaAcross);
    const double cosines = 4.0 * directions.cosLight * directions.cosView;
    if (point.tangent == glm::dvec3(0.0) || alpha.x == alpha.y) {
        return distributionGgx(point.alpha, directions.cosHalf) *
               maskingCorrelated(point.alpha, directions.cosLight, directions.cosView) / cosines;
    }
    // 1 + lambda(l) + lambda(v), each with the alpha along its direction, from 1/G1 = 1 + lambda.
    const double light = 1.0 / maskingSmith(alphaAlong(alpha, local(point, directions.toLight)), directions.cosLight);
    const double view = 1.0 / maskingSmith(alphaAlong(alpha, local(point, directions.toViewer)), directions.cosView);
    return distributionGgx(alpha, local(point, directions.half)) / (light + view - 1.0) / cosines;
}

/// KHR_materials_sheen, by the technique of scaling the albedo below.
glm::dvec3 underSheen(const SurfacePoint& point, const Directions& directions, const glm::dvec3& below, bool specular) {
    const double strongest = std::max({point.sheenColor.x, point.sheenColor.y, point.sheenColor.z});
    if (!(strongest > 0.0)) return below;
    const double albedo = std::max(sheenAlbedo(point.sheenAlpha, directions.cosLight),
                                   sheenAlbedo(point.sheenAlpha, std::max(directions.cosView, 0.0)));
    const glm::dvec3 brdf = below * std::max(1.0 - strongest * albedo, 0.0);
    if (!specular || !directions.hasLobe()) return brdf;
    return brdf + point.sheenColor * (distributionCharlie(point.sheenAlpha, directions.cosHalf) *
                                      visibilityCharlie(point.sheenAlpha, directions.cosLight, directions.cosView));
}

/// KHR_materials_clearcoat: the weight of the coat's lobe; the layers below get the rest.
double coatWeight(const SurfacePoint& point, const glm::dvec3& toViewer) {
    return point.coat * fresnelSchlick(0.04, 1.0, std::abs(glm::dot(point.coatNormal, toViewer)));
}

glm::dvec3 underCoat(const SurfacePoint& point, const glm::dvec3& below, const glm::dvec3& toLight,
                     const glm::dvec3& toViewer, bool specular) {
    const Directions directions(point.coatNormal, toLight, toViewer);
    const double weight = coatWeight(point, toViewer);
    double lobe = 0.0;
    if (specular && point.reflectsCoatLobe && directions.hasLobe()) {
        lobe = distributionGgx(point.coatAlpha, directions.cosHalf) *
               maskingCorrelated(point.coatAlpha, directions.cosLight, directions.cosView) /
               (4.0 * directions.cosView); // n.l cancels
    }
    return below * (1.0 - weight) + glm::dvec3(weight * lobe);
}

/// The Fresnel factor of metallic_roughness, for a viewer.
glm::dvec3 fresnelOf(const SurfacePoint& point, double cosIncidence, double cosView) {
    const ReflectanceRange range = reflectanceRange(point, cosView);
    glm::dvec3 f;
    for (int c = 0; c < 3; ++c) f[c] = fresnelSchlick(range.straight[c], range.grazing, cosIncidence);
    return f;
}

/// glTF 2.0 appendix B. Where there is no lobe, the Fresnel factor still attenuates the diffuse layer.
glm::dvec3 metallicRoughness(const SurfacePoint& point, const Directions& directions, bool specular) {
    const bool hasLobe = specular && point.reflectsLobe && directions.hasLobe();
    const double lobe = hasLobe ? glossyLobe(point, directions) : 0.0;
    const glm::dvec3 f = fresnelOf(point, directions.cosIncidence, directions.cosView);
    const double reflecting = (1.0 - point.metallic) * (1.0 - point.transmission);
    const glm::dvec3 diffuse = (1.0 - f) * (reflecting / std::numbers::pi) * point.color;
    return underSheen(point, directions, diffuse + f * lobe, specular) * directions.cosLight;
}

/// For models whose diffuse BRDF is the same in all directions.
glm::dvec3 colorOf(const SurfacePoint& point, const Directions&) {
    return point.color;
}

/// BRDF of the light that enters metallic_roughness, past metal, Fresnel reflection and sheen.
glm::dvec3 belowGloss(const SurfacePoint& point, const Directions& directions) {
    Directions lit = directions;
    lit.cosLight = std::max(directions.cosLight, 0.0);
    const glm::dvec3 entering = 1.0 - fresnelOf(point, lit.cosIncidence, lit.cosView);
    const glm::dvec3 brdf = entering * ((1.0 - point.metallic) / std::numbers::pi) * point.color;
    return underSheen(point, lit, brdf, false);
}

/// Wrapped diffuse light: (n.l + w) / (1 + w) instead of n.l, by channel. Source: Green 2004, "Real-Time Approximations
/// to Subsurface Scattering", GPU Gems, chapter 16.
glm::dvec3 wrapped(const SurfacePoint& point, const Directions& directions, const glm::dvec3& highlight) {
    glm::dvec3 cosine;
    for (int c = 0; c < 3; ++c)
        cosine[c] = std::clamp((directions.cosLight + point.wrap[c]) / (1.0 + point.wrap[c]), 0.0, 1.0);
    return modelOf(point.model).entering(point, directions) * cosine + highlight;
}

/// Mirrors have no masking, whatever the option.
glm::dvec3 mirroredByMicrofacet(const SurfacePoint& point, double cosView) {
    return point.specularColor * fresnelDielectric(point.ior, cosView);
}

glm::dvec3 mirroredByMetallicRoughness(const SurfacePoint& point, double cosView) {
    const double strongest = std::max({point.sheenColor.x, point.sheenColor.y, point.sheenColor.z});
    const double covered = strongest > 0.0 ? strongest * sheenAlbedo(point.sheenAlpha, cosView) : 0.0;
    return fresnelOf(point, cosView, cosView) * std::max(1.0 - covered, 0.0);
}

bool isMirror(const SurfacePoint& point) {
    return modelOf(point.model).mirrored && point.alpha <= kSmallestAlpha && point.alphaAcross <= kSmallestAlpha;
}

bool hasMirrorCoat(const SurfacePoint& point) {
    return point.coat > 0.0 && point.coatAlpha <= kSmallestAlpha;
}

constexpr Model kModels[] = {
    {MaterialModel::SingleColor, unlit, colorOf},
    {MaterialModel::Lambert, lambert, colorOf},
    {MaterialModel::BlinnPhong, blinnPhong, colorOf},
    {MaterialModel::Microfacet, microfacet, colorOf, mirroredByMicrofacet},
    {MaterialModel::MicrofacetAnisotropic, microfacetAnisotropic, colorOf, mirroredByMicrofacet},
    {MaterialModel::MetallicRoughness, metallicRoughness, belowGloss, mirroredByMetallicRoughness},
};
static_assert(std::size(kModels) == scenes::kMaterialModelCount);

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

ReflectanceRange reflectanceRange(const SurfacePoint& point, double cosView) {
    const double contrast = (point.ior - 1.0) / (point.ior + 1.0);
    ReflectanceRange range;
    range.grazing = point.specularFactor + (1.0 - point.specularFactor) * point.metallic;
    for (int c = 0; c < 3; ++c) {
        const double dielectric = std::min(contrast * contrast * point.specularColor[c], 1.0) * point.specularFactor;
        range.straight[c] = dielectric + (point.color[c] - dielectric) * point.metallic;
    }
    if (!(point.film > 0.0)) return range;
    const double cosine = std::clamp(cosView, 0.1, 1.0); // by definition: at smaller cosines F0 hardly matters
    const glm::dvec3 film = filmReflectance(range.straight, cosine, point.filmIor, point.filmThicknessNm);
    for (int c = 0; c < 3; ++c) {
        const double shown = std::lerp(fresnelSchlick(range.straight[c], range.grazing, cosine), film[c], point.film);
        // The straight reflectance that solves shown = straight + (grazing - straight) (1 - cosine)^5.
        const double ofGrazing = std::pow(1.0 - cosine, 5);
        range.straight[c] = std::clamp((shown - range.grazing * ofGrazing) / (1.0 - ofGrazing), 0.0, 1.0);
    }
    return range;
}

glm::dvec3 reflected(const SurfacePoint& point, const glm::dvec3& toLight, const glm::dvec3& toViewer, bool specular) {
    const Directions directions(point.normal, toLight, toViewer);
    glm::dvec3 brdfCosine(0.0);
    const Model& model = modelOf(point.model);
    if (directions.cosLight > 0.0) brdfCosine = model.reflected(point, directions, specular);
    if (point.wrap != glm::dvec3(0.0)) {
        glm::dvec3 highlight(0.0);
        if (specular && directions.cosLight > 0.0) highlight = brdfCosine - model.reflected(point, directions, false);
        brdfCosine = wrapped(point, directions, highlight);
    }
    return point.coat > 0.0 ? underCoat(point, brdfCosine, toLight, toViewer, specular) : brdfCosine;
}

std::vector<Mirror> mirrorsOf(const SurfacePoint& point, const glm::dvec3& toViewer) {
    std::vector<Mirror> mirrors;
    const auto add = [&](const glm::dvec3& normal, const glm::dvec3& share) {
        mirrors.push_back({2.0 * glm::dot(normal, toViewer) * normal - toViewer, share});
    };
    const double cosView = glm::dot(point.normal, toViewer),
                 coat = point.coat > 0.0 ? coatWeight(point, toViewer) : 0.0;
    if (isMirror(point) && cosView > 0.0)
        add(point.normal, (1.0 - coat) * modelOf(point.model).mirrored(point, cosView));
    if (hasMirrorCoat(point) && glm::dot(point.coatNormal, toViewer) > 0.0) add(point.coatNormal, glm::dvec3(coat));
    return mirrors;
}

SurfacePoint withoutMirrors(const SurfacePoint& point) {
    SurfacePoint rest = point;
    rest.reflectsLobe = rest.reflectsLobe && !isMirror(point);
    rest.reflectsCoatLobe = rest.reflectsCoatLobe && !hasMirrorCoat(point);
    return rest;
}

glm::dvec3 passedOn(const SurfacePoint& point, const glm::dvec3& toLight, const glm::dvec3& toViewer) {
    const Directions directions(point.normal, toLight, toViewer);
    if (!point.passes || directions.cosLight >= 0.0) return glm::dvec3(0.0);
    const double uncoated = point.coat > 0.0 ? 1.0 - coatWeight(point, toViewer) : 1.0;
    return modelOf(point.model).entering(point, directions) * (-directions.cosLight * uncoated);
}

glm::dvec3 transmittanceOf(const SurfacePoint& point, const glm::dvec3& toViewer) {
    return glm::max(1.0 - reflectedOfEvenLight(point, toViewer), glm::dvec3(0.0));
}

glm::dvec3 passingIfNoneReflected(const SurfacePoint& point, const glm::dvec3& toViewer) {
    const double cosView = glm::dot(point.normal, toViewer);
    const double strongest = std::max({point.sheenColor.x, point.sheenColor.y, point.sheenColor.z});
    double share = point.transmission * (1.0 - point.passingMetallic.value_or(point.metallic));
    if (strongest > 0.0)
        share *= std::max(1.0 - strongest * sheenAlbedo(point.sheenAlpha, std::max(cosView, 0.0)), 0.0);
    if (point.coat > 0.0) share *= 1.0 - coatWeight(point, toViewer);
    return share * point.passingColor.value_or(point.color);
}

glm::dvec3 leftByBody(const SurfacePoint& point, const glm::dvec3& wayMetres) {
    glm::dvec3 left(1.0);
    for (int c = 0; c < 3; ++c)
        if (wayMetres[c] > 0.0) left[c] = std::exp(-point.bodyPerMetre[c] * wayMetres[c]); // absorption may be infinite
    return left;
}

std::optional<glm::dvec3> refracted(const SurfacePoint& point, const glm::dvec3& toViewer, double ior) {
    const double cosView = glm::dot(point.normal, toViewer);
    const glm::dvec3 outward = cosView < 0.0 ? -point.normal : point.normal;
    const glm::dvec3 across = toViewer - glm::dot(toViewer, outward) * outward;
    // KHR_materials_ior: an index of 0 stands for infinity.
    const double sine = glm::length(across), bentSine = ior > 0.0 ? sine / ior : 0.0;
    if (!(bentSine <= 1.0)) return std::nullopt;
    const glm::dvec3 along = sine > 0.0 ? across / sine : glm::dvec3(0.0);
    const double angle = std::asin(bentSine);
    return -std::cos(angle) * outward - std::sin(angle) * along;
}

glm::dvec3 iorsOf(const SurfacePoint& point) {
    if (!(point.dispersion > 0.0) || point.ior <= 1.0) return glm::dvec3(point.ior);
    const double abbeNumber = 20.0 / point.dispersion; // (n_d - 1) / (n_F - n_C)
    const double fromRedToBlue = (point.ior - 1.0) / abbeNumber;
    return {std::max(point.ior - fromRedToBlue / 2.0, 1.0), point.ior, point.ior + fromRedToBlue / 2.0};
}

glm::dvec3 leaving(const SurfacePoint& point, const glm::dvec3& toViewer, double preScatterShare) {
    // By reciprocity as much as would enter from the mirrored direction of the viewer.
    const glm::dvec3 mirrored = 2.0 * glm::dot(point.normal, toViewer) * point.normal - toViewer;
    glm::dvec3 brdf = modelOf(point.model).entering(point, Directions(point.normal, mirrored, toViewer));
    for (int c = 0; c < 3; ++c)
        brdf[c] = point.color[c] > 0.0 ? brdf[c] * std::pow(point.color[c], -preScatterShare) : 0.0;
    const double uncoated = point.coat > 0.0 ? 1.0 - coatWeight(point, toViewer) : 1.0;
    return brdf * uncoated;
}

glm::dvec3 emitted(const SurfacePoint& point, const glm::dvec3& toViewer) {
    return point.coat > 0.0 ? point.emission * (1.0 - coatWeight(point, toViewer)) : point.emission;
}

} // namespace tessera::reference
