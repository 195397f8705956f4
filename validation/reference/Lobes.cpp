#include "validation/reference/Lobes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tessera::reference {

namespace {

constexpr double kSmallestCosine = 1e-6;

/// L(x) of the source's table 1, interpolated between its rows for alpha 1 and 0 by (1 - alpha)^2.
double charlieFit(double x, double alpha) {
    const double smooth = (1.0 - alpha) * (1.0 - alpha);
    const double a = std::lerp(21.5473, 25.3245, smooth), b = std::lerp(3.82987, 3.32435, smooth);
    const double c = std::lerp(0.19823, 0.16801, smooth), d = std::lerp(-1.97760, -1.27393, smooth);
    const double e = std::lerp(-4.32054, -4.85967, smooth);
    return a / (1.0 + b * std::pow(x, c)) + d * x + e;
}

double charlieLambda(double cosine, double alpha) {
    if (cosine < 0.5) return std::exp(charlieFit(cosine, alpha));
    return std::exp(2.0 * charlieFit(0.5, alpha) - charlieFit(std::max(1.0 - cosine, 0.0), alpha));
}

} // namespace

double distributionGgx(const glm::dvec2& alpha, const glm::dvec3& half) {
    if (!(half.z > 0.0)) return 0.0;
    const glm::dvec2 slope = glm::dvec2(half) / alpha;
    const double spread = glm::dot(slope, slope) + half.z * half.z;
    return 1.0 / (std::numbers::pi * alpha.x * alpha.y * spread * spread);
}

double alphaAlong(const glm::dvec2& alpha, const glm::dvec3& direction) {
    const glm::dvec2 flat(direction);
    const double length2 = glm::dot(flat, flat);
    if (length2 == 0.0) return std::sqrt(0.5 * glm::dot(alpha, alpha));
    return glm::length(alpha * flat) / std::sqrt(length2);
}

double distributionCharlie(double alpha, double cosNormalHalf) {
    const double sine = std::sqrt(std::max(1.0 - cosNormalHalf * cosNormalHalf, 0.0));
    return (2.0 + 1.0 / alpha) * std::pow(sine, 1.0 / alpha) / (2.0 * std::numbers::pi);
}

double visibilityCharlie(double alpha, double cosLight, double cosView) {
    const double masking = 1.0 + charlieLambda(cosLight, alpha) + charlieLambda(cosView, alpha);
    return 1.0 / (masking * 4.0 * std::max(cosLight, kSmallestCosine) * std::max(cosView, kSmallestCosine));
}

double sheenAlbedo(double alpha, double cosine) {
    // ln E by powers of x = cosine / roughness (rows) and of the perceptual roughness (columns).
    constexpr double kFit[5][5] = {{0.91988, -5.00894, 6.4925, -1.28465, -1.16741},
                                   {0.184121, -10.31, 16.0261, -8.39721, -0.622238},
                                   {-0.138722, -8.60875, 46.7629, -71.9604, 37.6528},
                                   {-0.227684, 6.143, -19.9518, 30.9158, -21.028},
                                   {0.0428847, -0.844431, 2.72363, -10.4857, 10.4773}};
    const double roughness = std::max(std::sqrt(alpha), 0.05);
    const double x = std::min(cosine / roughness, 5.0);
    double logarithm = 0.0;
    for (int i = 0; i < 5; ++i) {
        for (int j = 0; j < 5; ++j) logarithm += kFit[i][j] * std::pow(x, i) * std::pow(roughness, j);
    }
    return std::min(std::exp(logarithm), 1.0);
}

} // namespace tessera::reference
