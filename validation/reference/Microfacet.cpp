#include "validation/reference/Microfacet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tessera::reference {

namespace {

double tangentSquared(double cosine) {
    const double cosineSquared = cosine * cosine;
    return std::max(1.0 - cosineSquared, 0.0) / cosineSquared;
}

} // namespace

double distributionGgx(double alpha, double cosNormalHalf) {
    if (!(cosNormalHalf > 0.0)) return 0.0;
    const double spread = alpha * alpha + tangentSquared(cosNormalHalf);
    return alpha * alpha / (std::numbers::pi * std::pow(cosNormalHalf, 4) * spread * spread);
}

double maskingSmith(double alpha, double cosNormal) {
    return 2.0 / (1.0 + std::sqrt(1.0 + alpha * alpha * tangentSquared(cosNormal)));
}

double maskingCorrelated(double alpha, double cosNormalLight, double cosNormalView) {
    const auto lambda = [alpha](double cosine) {
        return 0.5 * (std::sqrt(1.0 + alpha * alpha * tangentSquared(cosine)) - 1.0);
    };
    return 1.0 / (1.0 + lambda(cosNormalLight) + lambda(cosNormalView));
}

double fresnelDielectric(double ior, double cosIncidence) {
    if (ior == 1.0) return 0.0; // no interface; Snell's law alone would leave 1 at exactly grazing incidence
    const double cosIn = std::min(std::abs(cosIncidence), 1.0);
    const double sineOut = std::sqrt(1.0 - cosIn * cosIn) / ior;
    if (!(sineOut < 1.0)) return 1.0;
    const double cosOut = std::sqrt(1.0 - sineOut * sineOut);
    const double perpendicular = (cosIn - ior * cosOut) / (cosIn + ior * cosOut);
    const double parallel = (ior * cosIn - cosOut) / (ior * cosIn + cosOut);
    return 0.5 * (perpendicular * perpendicular + parallel * parallel);
}

double fresnelSchlick(double f0, double f90, double cosIncidence) {
    return f0 + (f90 - f0) * std::pow(std::clamp(1.0 - cosIncidence, 0.0, 1.0), 5);
}

} // namespace tessera::reference
