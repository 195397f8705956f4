#pragma once
#include <cmath>
#include <numbers>

#include "scenes/Scene.h"

/// What a surface sends to the eye, in double precision and in the form the books print it: angles and tangents, no
/// cancellation-free rewriting, no code shared with the engine.
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

/// The model's outgoing radiance for unit incident intensity, for materials without textures.
inline glm::dvec3 reflected(const scenes::Material& m, const glm::dvec3& n, const glm::dvec3& l, const glm::dvec3& v) {
    const double nl = glm::dot(n, l), nv = glm::dot(n, v);
    if (nl <= 0.0) return glm::dvec3(0.0);
    const glm::dvec3 base(m.baseColor), tint(m.specularColor), h = glm::normalize(l + v);
    const double nh = glm::dot(n, h), lh = glm::dot(l, h);
    if (m.model == scenes::MaterialModel::Lambert) return base * nl;
    if (m.model == scenes::MaterialModel::Microfacet) {
        const double alpha = std::max(double(m.alpha), 1e-3);
        const double g = smith(alpha, nl) * smith(alpha, nv);
        const double lobe = nv > 0.0 ? fresnel(m.ior, lh) * distribution(alpha, nh) * g / (4.0 * nl * nv) : 0.0;
        return (base + tint * lobe) * nl;
    }
    // glTF 2.0 appendix B, with F0 and F90 of KHR_materials_ior and KHR_materials_specular.
    const double alpha = std::max(squared(m.perceptualRoughness), 1e-3), metallic = m.metallic;
    const double dielectric = squared((double(m.ior) - 1.0) / (double(m.ior) + 1.0));
    const glm::dvec3 f0 =
        glm::mix(glm::min(dielectric * tint, glm::dvec3(1.0)) * double(m.specularFactor), base, metallic);
    const double f90 = m.specularFactor + (1.0 - m.specularFactor) * metallic;
    const glm::dvec3 f = f0 + (glm::dvec3(f90) - f0) * std::pow(1.0 - lh, 5);
    const double lobe = nv > 0.0 ? distribution(alpha, nh) * correlatedMasking(alpha, nl, nv) / (4.0 * nl * nv) : 0.0;
    return ((glm::dvec3(1.0) - f) * (1.0 - metallic) * base / std::numbers::pi + f * lobe) * nl;
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
