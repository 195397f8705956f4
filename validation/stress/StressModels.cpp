#include "validation/stress/StressModels.h"

#include <algorithm>
#include <cmath>

#include "shaders/shared/models.h"

namespace tessera::validation {

namespace {

using scenes::Material;
using scenes::MaterialModel;

/// Often at the floor of alpha and at its end 1, else of any order of magnitude.
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

/// 0 and 1 as often as what lies between.
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

void randomMetallicRoughness(Material& material, StressRandom& random) {
    material.baseColor = glm::vec4(random.color(), 1.0f);
    material.metallic = randomShare(random);
    material.perceptualRoughness = std::sqrt(randomAlpha(random));
    material.ior = float(random.logarithmic(1.0, 1000.0));
    material.specularFactor = randomShare(random);
    material.specularColor = random.color();
}

double floored(double alpha) {
    return std::max(alpha, double(ALPHA_MIN));
}

constexpr StressModel kModels[] = {
    {MaterialModel::Lambert, "lambert", randomLambert, nullptr, [](const Material&) { return 1.0; }},
    {MaterialModel::Microfacet, "microfacet", randomMicrofacet,
     [](Material& material, double roughness) { material.alpha = float(roughness); },
     [](const Material& material) { return floored(material.alpha); }},
    {MaterialModel::MetallicRoughness, "metallic_roughness", randomMetallicRoughness,
     [](Material& material, double roughness) { material.perceptualRoughness = float(roughness); },
     [](const Material& material) {
         return floored(double(material.perceptualRoughness) * material.perceptualRoughness);
     }},
};

} // namespace

std::span<const StressModel> stressModels() {
    return kModels;
}

} // namespace tessera::validation
