#pragma once
#include <cmath>
#include <numbers>

#include <glm/glm.hpp>

namespace tessera::test {

/// A half vector of a quadrature over the hemisphere about +z.
struct HalfVector {
    glm::dvec3 h;
    double weight; ///< solid angle in steradians
};

/// Midpoint rule over the half vectors h of GGX at `alpha`, with tan theta = alpha tan psi, and psi and phi equally
/// spaced: D cos theta becomes sin 2 psi / 2 pi, so the lobe is resolved equally well for every alpha. phi covers half
/// a turn only, doubled by the weight, as every integrand here is even in phi.
template <typename Visit>
void forHalfVectors(double alpha, int psiSteps, int phiSteps, const Visit& visit) {
    using std::numbers::pi;
    for (int i = 0; i < psiSteps; ++i) {
        const double psi = 0.5 * pi * (i + 0.5) / psiSteps, t = std::tan(psi);
        const double cosine = 1.0 / std::sqrt(1.0 + alpha * alpha * t * t), sine = alpha * t * cosine;
        const double thetaPerPsi = alpha * (1.0 + t * t) / (1.0 + alpha * alpha * t * t);
        const double weight = sine * thetaPerPsi * (0.5 * pi / psiSteps) * (2.0 * pi / phiSteps);
        for (int j = 0; j < phiSteps; ++j) {
            const double phi = pi * (j + 0.5) / phiSteps;
            visit(HalfVector{{sine * std::cos(phi), sine * std::sin(phi), cosine}, weight});
        }
    }
}

} // namespace tessera::test
