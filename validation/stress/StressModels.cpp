#include "validation/stress/StressModels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shaders/shared/models.h"

namespace tessera::validation {

namespace {

using scenes::Material;
using scenes::MaterialModel;

/// Often at the minimum of alpha and at 1, else of any order of magnitude.
float randomAlpha(StressRandom& random) {
    switch (random.index(8)) {
    case 0:
        return 0.0f;
    case 1:
        return 1.0f;
    default:
        return float(random.logarithmic(ALPHA_MIN, 1.0));
    }
}

/// 0 or 1 in a third of the draws, else a value between them.
float randomShare(StressRandom& random) {
    return random.index(3) == 0 ? float(random.index(2)) : float(random.unit());
}

void randomLambert(Material& material, StressRandom& random) {
    material.baseColor = glm::vec4(random.color(), 1.0f);
}

void randomMicrofacet(Material& material, StressRandom& random) {
    material.baseColor = glm::vec4(random.color() * randomShare(random), 1.0f);
    material.specularColor = random.color();
    material.alpha = randomAlpha(random);
    // Below 1 there is total internal reflection; at 1 there is no interface.
    material.ior = random.index(16) == 0 ? 1.0f : float(random.logarithmic(0.2, 1000.0));
}

void randomBlinnPhong(Material& material, StressRandom& random) {
    material.baseColor = glm::vec4(random.color() * randomShare(random), 1.0f);
    material.specularColor = random.color();
    material.exponent = random.index(8) == 0 ? 0.0f : float(random.logarithmic(0.1, 1e5));
}

void randomAnisotropic(Material& material, StressRandom& random) {
    randomMicrofacet(material, random);
    material.alphaY = randomAlpha(random);
    material.masking = random.index(2) == 0 ? scenes::Masking::Walter : scenes::Masking::Directional;
}

void randomMetallicRoughness(Material& material, StressRandom& random) {
    material.baseColor = glm::vec4(random.color(), 1.0f);
    material.metallic = randomShare(random);
    material.perceptualRoughness = std::sqrt(randomAlpha(random));
    material.ior = float(random.logarithmic(1.0, 1000.0));
    material.specularFactor = randomShare(random);
    material.specularColor = random.color();
    // Each layer is present in half of the materials.
    if (random.index(2) == 0) {
        material.anisotropyStrength = randomShare(random);
        material.anisotropyRotationRadians = float(random.unit() * 2.0 * std::numbers::pi);
    }
    if (random.index(2) == 0) {
        material.clearcoat = randomShare(random);
        material.clearcoatPerceptualRoughness = std::sqrt(randomAlpha(random));
    }
    if (random.index(2) == 0) {
        material.sheenColor = random.color();
        material.sheenPerceptualRoughness = std::sqrt(randomAlpha(random));
    }
}

double floored(double alpha) {
    return std::max(alpha, double(ALPHA_MIN));
}

double flooredSquare(double perceptualRoughness) {
    return floored(perceptualRoughness * perceptualRoughness);
}

/// x^p multiplies a relative error of x by p; a lobe multiplies one of a direction by 2/alpha.
double sharpnessOfExponent(const Material& material) {
    return std::min(1.0, 2.0 / std::max(double(material.exponent), 2.0));
}

/// Alpha of the sharpest layer. Anisotropy only raises one of two alphas. Sheen is a sine to the power 1/alpha.
double sharpnessOfLayers(const Material& material) {
    double sharpness = flooredSquare(material.perceptualRoughness);
    if (material.clearcoat > 0.0f)
        sharpness = std::min(sharpness, flooredSquare(material.clearcoatPerceptualRoughness));
    if (material.sheenColor != glm::vec3(0.0f))
        sharpness = std::min(sharpness, flooredSquare(material.sheenPerceptualRoughness));
    return sharpness;
}

constexpr StressModel kModels[] = {
    {MaterialModel::Lambert, randomLambert, nullptr, [](const Material&) { return 1.0; }},
    {MaterialModel::BlinnPhong, randomBlinnPhong, nullptr, sharpnessOfExponent},
    {MaterialModel::Microfacet, randomMicrofacet,
     [](Material& material, double roughness) { material.alpha = float(roughness); },
     [](const Material& material) { return floored(material.alpha); }},
    {MaterialModel::MicrofacetAnisotropic, randomAnisotropic,
     [](Material& material, double roughness) { material.alpha = float(roughness); },
     [](const Material& material) { return floored(std::min(material.alpha, material.alphaY)); }},
    {MaterialModel::MetallicRoughness, randomMetallicRoughness,
     [](Material& material, double roughness) { material.perceptualRoughness = float(roughness); }, sharpnessOfLayers},
};

} // namespace

std::span<const StressModel> stressModels() {
    return kModels;
}

} // namespace tessera::validation
