#pragma once
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "scenes/Scene.h"

/// The radiance that a surface reflects to the eye, in double precision and in the textbooks' form: angles and
/// tangents, no cancellation-free rewriting, no code shared with the engine.
namespace tessera::test::textbook {

inline double chi(double x) {
    return x > 0.0 ? 1.0 : 0.0;
}
inline double squared(double x) {
    return x * x;
}
inline double tangentSquared(double cosine) {
    return (1.0 - cosine * cosine) / (cosine * cosine);
}

/// GGX. Walter 2007, "Microfacet Models for Refraction through Rough Surfaces", equation 33.
inline double distribution(double alpha, double cosine) {
    const double spread = squared(alpha) + tangentSquared(cosine);
    return squared(alpha) * chi(cosine) / (std::numbers::pi * std::pow(cosine, 4) * squared(spread));
}

/// Walter 2007, equation 34.
inline double smith(double alpha, double cosine) {
    return 2.0 / (1.0 + std::sqrt(1.0 + squared(alpha) * tangentSquared(cosine)));
}

/// Heitz 2014, "Understanding the Masking-Shadowing Function", equation 99.
inline double correlatedMasking(double alpha, double cosineLight, double cosineView) {
    const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1.0 + squared(alpha) * tangentSquared(c)) - 1.0); };
    return 1.0 / (1.0 + lambda(cosineLight) + lambda(cosineView));
}

/// Fresnel's equations for the two polarisations with Snell's law, averaged.
inline double fresnel(double ior, double cosine) {
    const double sineOut = std::sqrt(1.0 - cosine * cosine) / ior;
    if (sineOut >= 1.0) return 1.0;
    const double out = std::sqrt(1.0 - sineOut * sineOut);
    const double s = (cosine - ior * out) / (cosine + ior * out), p = (ior * cosine - out) / (ior * cosine + out);
    return 0.5 * (s * s + p * p);
}

/// GGX with two alphas. Burley 2012, "Physically-Based Shading at Disney", equation 13. `m` in the frame of tangent,
/// bitangent and normal.
inline double distribution(double alphaX, double alphaY, const glm::dvec3& m) {
    const double spread = squared(m.x / alphaX) + squared(m.y / alphaY) + squared(m.z);
    return chi(m.z) / (std::numbers::pi * alphaX * alphaY * squared(spread));
}

/// The alpha of an anisotropic lobe along the projection of a direction. Heitz 2014, section 5.3.
inline double alphaAlong(double alphaX, double alphaY, const glm::dvec3& direction) {
    const double flat = squared(direction.x) + squared(direction.y);
    if (flat == 0.0) return std::sqrt(0.5 * (squared(alphaX) + squared(alphaY)));
    return std::sqrt((squared(alphaX * direction.x) + squared(alphaY * direction.y)) / flat);
}

/// G of the microfacet models by their masking option; directions in the frame of tangent, bitangent and normal.
inline double masking(const scenes::Material& m, const glm::dvec3& l, const glm::dvec3& v, const glm::dvec3& h) {
    const bool anisotropic = m.model == scenes::MaterialModel::MicrofacetAnisotropic;
    const double alphaX = std::max(double(m.alpha), 1e-3);
    const double alphaY = anisotropic ? std::max(double(m.alphaY), 1e-3) : alphaX;
    if (m.masking == scenes::Masking::Directional)
        return smith(alphaAlong(alphaX, alphaY, l), l.z) * smith(alphaAlong(alphaX, alphaY, v), v.z);
    const double alpha = alphaAlong(alphaX, alphaY, h);
    if (m.masking == scenes::Masking::HalfVector) return smith(alpha, glm::dot(l, h)) * smith(alpha, glm::dot(v, h));
    return smith(alpha, l.z) * smith(alpha, v.z);
}

/// KHR_materials_sheen, "Sheen visibility": Lambda of Conty Estevez and Kulla 2017.
inline double sheenLambda(double cosine, double alpha) {
    const auto l = [&](double x) {
        const double w = squared(1.0 - alpha);
        const double a = std::lerp(21.5473, 25.3245, w), b = std::lerp(3.82987, 3.32435, w);
        const double c = std::lerp(0.19823, 0.16801, w), d = std::lerp(-1.97760, -1.27393, w);
        return a / (1.0 + b * std::pow(x, c)) + d * x + std::lerp(-4.32054, -4.85967, w);
    };
    return cosine < 0.5 ? std::exp(l(cosine)) : std::exp(2.0 * l(0.5) - l(1.0 - cosine));
}

inline double sheen(double alpha, const glm::dvec3& l, const glm::dvec3& v, const glm::dvec3& h) {
    const double d = (2.0 + 1.0 / alpha) * std::pow(1.0 - squared(h.z), 0.5 / alpha) / (2.0 * std::numbers::pi);
    return d / ((1.0 + sheenLambda(v.z, alpha) + sheenLambda(l.z, alpha)) * 4.0 * v.z * l.z);
}

/// Directional albedo of a white sheen, by numerical integration.
inline double sheenEnergy(double alpha, double cosine) {
    constexpr int kSteps = 128;
    const glm::dvec3 v(std::sqrt(1.0 - squared(cosine)), 0.0, cosine);
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double theta = 0.5 * std::numbers::pi * (i + 0.5) / kSteps;
        for (int j = 0; j < kSteps; ++j) {
            const double phi = std::numbers::pi * (j + 0.5) / kSteps;
            const glm::dvec3 l(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
            sum += sheen(alpha, l, v, glm::normalize(l + v)) * l.z * std::sin(theta);
        }
    }
    return std::min(1.0, sum * squared(std::numbers::pi / kSteps));
}

/// The same from a table with cosine steps of 1/256, built at the first use of an alpha.
inline double tabledSheenEnergy(double alpha, double cosine) {
    constexpr int kSteps = 256;
    static std::map<double, std::vector<double>> tables;
    std::vector<double>& table = tables[alpha];
    for (int i = int(table.size()); i <= kSteps; ++i)
        table.push_back(sheenEnergy(alpha, std::max(i, 1) / double(kSteps)));
    const double at = std::clamp(cosine, 0.0, 1.0) * kSteps;
    const auto below = std::size_t(std::min(at, kSteps - 1.0));
    return std::lerp(table[below], table[below + 1], at - double(below));
}

/// Blinn-Phong; the highlight has no cosine factor. Blinn 1977.
inline glm::dvec3 blinnPhong(const scenes::Material& m, double nl, double nv, double nh) {
    const double highlight = nv > 0.0 ? std::pow(nh, double(m.exponent)) : 0.0;
    return glm::dvec3(m.baseColor) * nl + glm::dvec3(m.specularColor) * highlight;
}

/// KHR_materials_clearcoat: the coat's attenuation of the layers below.
inline double coatWeight(const scenes::Material& m, double nv) {
    return double(m.clearcoat) * (0.04 + 0.96 * std::pow(1.0 - std::abs(nv), 5));
}

/// The specular lobe without Fresnel, D G / (4 n.l n.v), of metallic_roughness with its alphas.
inline double gltfLobe(double alphaT, double alphaB, const glm::dvec3& l, const glm::dvec3& v, const glm::dvec3& h) {
    const auto lambda = [&](const glm::dvec3& x) {
        return 0.5 * (std::sqrt(1.0 + squared(alphaAlong(alphaT, alphaB, x)) * tangentSquared(x.z)) - 1.0);
    };
    return distribution(alphaT, alphaB, h) / (1.0 + lambda(l) + lambda(v)) / (4.0 * l.z * v.z);
}

/// reflected() for materials without subsurface scattering.
inline glm::dvec3 reflectedAtOnce(const scenes::Material& m, const glm::dvec3& n, const glm::dvec3& l,
                                  const glm::dvec3& v, const glm::dvec3& tangent) {
    const double nl = glm::dot(n, l), nv = glm::dot(n, v);
    if (nl <= 0.0) return glm::dvec3(0.0);
    const glm::dvec3 base(m.baseColor), tint(m.specularColor), h = glm::normalize(l + v);
    const double nh = glm::dot(n, h), lh = glm::dot(l, h);
    if (m.model == scenes::MaterialModel::Lambert) return base * nl;
    if (m.model == scenes::MaterialModel::BlinnPhong) return blinnPhong(m, nl, nv, nh);
    const double turn = m.model == scenes::MaterialModel::MetallicRoughness ? double(m.anisotropyRotationRadians) : 0.0;
    const glm::dvec3 bitangent = glm::cross(n, tangent);
    const glm::dvec3 t = std::cos(turn) * tangent + std::sin(turn) * bitangent;
    const auto local = [&](const glm::dvec3& x) {
        return glm::dvec3(glm::dot(x, t), glm::dot(x, glm::cross(n, t)), glm::dot(x, n));
    };
    if (m.model == scenes::MaterialModel::Microfacet || m.model == scenes::MaterialModel::MicrofacetAnisotropic) {
        const bool anisotropic = m.model == scenes::MaterialModel::MicrofacetAnisotropic;
        const double alpha = std::max(double(m.alpha), 1e-3);
        const double d =
            anisotropic ? distribution(alpha, std::max(double(m.alphaY), 1e-3), local(h)) : distribution(alpha, nh);
        const double g = masking(m, local(l), local(v), local(h));
        const double lobe = nv > 0.0 ? fresnel(m.ior, lh) * d * g / (4.0 * nl * nv) : 0.0;
        return (base + tint * lobe) * nl;
    }
    // glTF 2.0 appendix B, with F0 and F90 of KHR_materials_ior and KHR_materials_specular.
    const double alpha = std::max(squared(m.perceptualRoughness), 1e-3), metallic = m.metallic;
    const double dielectric = squared((double(m.ior) - 1.0) / (double(m.ior) + 1.0));
    const glm::dvec3 f0 =
        glm::mix(glm::min(dielectric * tint, glm::dvec3(1.0)) * double(m.specularFactor), base, metallic);
    const double f90 = m.specularFactor + (1.0 - m.specularFactor) * metallic;
    const glm::dvec3 f = f0 + (glm::dvec3(f90) - f0) * std::pow(1.0 - lh, 5);
    double lobe = nv > 0.0 ? distribution(alpha, nh) * correlatedMasking(alpha, nl, nv) / (4.0 * nl * nv) : 0.0;
    // KHR_materials_anisotropy: alpha grows along the tangent.
    if (m.anisotropyStrength > 0.0f && nv > 0.0)
        lobe = gltfLobe(std::lerp(alpha, 1.0, squared(m.anisotropyStrength)), alpha, local(l), local(v), local(h));
    glm::dvec3 share = (glm::dvec3(1.0) - f) * (1.0 - metallic) * base / std::numbers::pi + f * lobe;
    const glm::dvec3 hairs(m.sheenColor);
    const double strongest = std::max({hairs.x, hairs.y, hairs.z});
    if (strongest > 0.0) {
        const double hairAlpha = std::max(squared(m.sheenPerceptualRoughness), 1e-3);
        share *= 1.0 - strongest * std::max(tabledSheenEnergy(hairAlpha, nl), tabledSheenEnergy(hairAlpha, nv));
        if (nv > 0.0) share += hairs * sheen(hairAlpha, local(l), local(v), local(h));
    }
    if (m.clearcoat == 0.0f) return share * nl;
    // KHR_materials_clearcoat: a second lobe of ior 1.5, with Fresnel by the angle to the normal.
    const double coatAlpha = std::max(squared(m.clearcoatPerceptualRoughness), 1e-3);
    const double coat =
        nv > 0.0 ? distribution(coatAlpha, nh) * correlatedMasking(coatAlpha, nl, nv) / (4.0 * nl * nv) : 0.0;
    return glm::mix(share, glm::dvec3(coat), coatWeight(m, nv)) * nl;
}

/// Fraction of the light that enters a surface and leaves it towards the viewer, per solid angle, without n.l.
inline glm::dvec3 entering(const scenes::Material& m, double nl, double nv, double lh) {
    const glm::dvec3 base(m.baseColor);
    if (m.model != scenes::MaterialModel::MetallicRoughness) return base;
    const double dielectric = squared((double(m.ior) - 1.0) / (double(m.ior) + 1.0)), metallic = m.metallic;
    const glm::dvec3 f0 = glm::mix(
        glm::min(dielectric * glm::dvec3(m.specularColor), glm::dvec3(1.0)) * double(m.specularFactor), base, metallic);
    const double f90 = m.specularFactor + (1.0 - m.specularFactor) * metallic;
    const glm::dvec3 f = f0 + (glm::dvec3(f90) - f0) * std::pow(1.0 - lh, 5);
    const glm::dvec3 share = (glm::dvec3(1.0) - f) * (1.0 - metallic) * base / std::numbers::pi;
    const double strongest = std::max({m.sheenColor.x, m.sheenColor.y, m.sheenColor.z});
    if (strongest == 0.0) return share;
    const double hairAlpha = std::max(squared(m.sheenPerceptualRoughness), 1e-3);
    return share * (1.0 - strongest * std::max(tabledSheenEnergy(hairAlpha, nl), tabledSheenEnergy(hairAlpha, nv)));
}

/// The model's outgoing radiance for unit incident intensity, for materials without textures. `tangent` is the surface
/// tangent before the material rotates it.
inline glm::dvec3 reflected(const scenes::Material& m, const glm::dvec3& n, const glm::dvec3& l, const glm::dvec3& v,
                            const glm::dvec3& tangent = {1, 0, 0}) {
    const glm::dvec3 atOnce = reflectedAtOnce(m, n, l, v, tangent);
    if (m.subsurface.method != scenes::SubsurfaceMethod::Wrap) return atOnce;
    const double nl = glm::dot(n, l), nv = glm::dot(n, v), lit = std::max(nl, 0.0);
    const glm::dvec3 below = entering(m, lit, std::max(nv, 0.0), glm::dot(l, glm::normalize(l + v)));
    const glm::dvec3 wrap = double(m.subsurface.wrap) * glm::dvec3(m.subsurface.wrapTint);
    const glm::dvec3 wrapped = glm::max((nl + wrap) / (1.0 + wrap), glm::dvec3(0.0));
    return atOnce + (1.0 - coatWeight(m, nv)) * below * (wrapped - lit);
}

/// The light's intensity at a point, and the unit direction to it.
inline glm::dvec3 incident(const scenes::Light& light, const glm::dvec3& positionWS, glm::dvec3& toLightWS) {
    const glm::dvec3 full = glm::dvec3(light.color) * double(light.intensity);
    toLightWS = -light.directionWS;
    if (light.type == scenes::LightType::Directional) return full;
    const double d = glm::distance(light.positionWS, positionWS);
    toLightWS = (light.positionWS - positionWS) / d;
    double falloff = 0.0;
    if (light.falloff == scenes::Falloff::Attenuation) {
        falloff = 1.0 / (light.attenuation.x + light.attenuation.y * d + light.attenuation.z * d * d);
    } else if (d < light.rangeMetres) {
        falloff = squared(1.0 - std::pow(d / light.rangeMetres, 4)) / (d * d);
    }
    if (light.type == scenes::LightType::Spot) {
        const double inner = std::cos(light.innerConeRadians), outer = std::cos(light.outerConeRadians);
        const double share = (-glm::dot(toLightWS, light.directionWS) - outer) / std::max(0.001, inner - outer);
        falloff *= squared(std::min(1.0, std::max(0.0, share)));
    }
    return full * falloff;
}

} // namespace tessera::test::textbook
