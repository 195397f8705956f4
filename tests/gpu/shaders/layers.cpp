// Coat and sheen: their terms, and how they are layered over the rest of a material.
#include <gtest/gtest.h>

#include "tests/gpu/shaders/LobeBench.h"

namespace tessera {
namespace {

using test::LobeCase;
using test::LobeResult;
using test::LobeTerms;
using test::TermsCase;

/// The fit of Conty Estevez and Kulla 2017, table 1, in double.
double charlieLambda(double cosine, double alpha) {
    const auto fit = [&](double x) {
        const double w = (1.0 - alpha) * (1.0 - alpha);
        const auto between = [&](double rough, double smooth) { return rough * (1.0 - w) + smooth * w; };
        const double a = between(21.5473, 25.3245), b = between(3.82987, 3.32435), c = between(0.19823, 0.16801);
        const double d = between(-1.97760, -1.27393), e = between(-4.32054, -4.85967);
        return a / (1.0 + b * std::pow(x, c)) + d * x + e;
    };
    return cosine < 0.5 ? std::exp(fit(cosine)) : std::exp(2.0 * fit(0.5) - fit(1.0 - cosine));
}

double charlie(double sine, double alpha) {
    return (2.0 + 1.0 / alpha) * std::pow(sine, 1.0 / alpha) / (2.0 * test::pi);
}

double sheenLobe(const glm::dvec3& l, const glm::dvec3& v, double alpha) {
    const double cosine = glm::normalize(l + v).z, sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return charlie(sine, alpha) / ((1.0 + charlieLambda(l.z, alpha) + charlieLambda(v.z, alpha)) * 4.0 * l.z * v.z);
}

/// Visits light directions of the hemisphere with their solid angles, by the midpoint rule in both angles. All
/// integrands here are even in phi.
template <typename Visit>
void forLights(int steps, const Visit& visit) {
    for (int i = 0; i < steps; ++i) {
        const double theta = 0.5 * test::pi * (i + 0.5) / steps;
        for (int j = 0; j < steps; ++j) {
            const double phi = test::pi * (j + 0.5) / steps, sine = std::sin(theta);
            visit(glm::dvec3(sine * std::cos(phi), sine * std::sin(phi), std::cos(theta)),
                  sine * (0.5 * test::pi / steps) * (2.0 * test::pi / steps));
        }
    }
}

double sheenEnergy(double mu, double alpha, int steps) {
    const glm::dvec3 v(std::sqrt(1.0 - mu * mu), 0.0, mu);
    double sum = 0.0;
    forLights(steps, [&](const glm::dvec3& l, double solidAngle) { sum += sheenLobe(l, v, alpha) * l.z * solidAngle; });
    return sum;
}

using Sheen = test::LobeTest;

TEST_F(Sheen, theDistributionOfHairsIntegratesToOne) {
    for (const float alpha : {0.01f, 0.1f, 0.5f, 1.0f}) {
        constexpr int kSteps = 4096;
        std::vector<TermsCase> cases;
        for (int i = 0; i < kSteps; ++i) {
            const double theta = 0.5 * test::pi * (i + 0.5) / kSteps;
            TermsCase c;
            c.alpha = glm::vec2(alpha);
            c.h = {float(std::sin(theta)), 0.0f, float(std::cos(theta))};
            cases.push_back(c);
        }
        const std::vector<LobeTerms> found = terms(cases);
        double sum = 0.0;
        for (int i = 0; i < kSteps; ++i) {
            const double theta = 0.5 * test::pi * (i + 0.5) / kSteps;
            sum += double(found[std::size_t(i)].charlieD) * std::cos(theta) * std::sin(theta) * 2.0 * test::pi *
                   (0.5 * test::pi / kSteps);
        }
        EXPECT_NEAR(sum, 1.0, 1e-5) << alpha; // fp32 errors of either sign, and a midpoint rule of 4096 steps
    }
}

TEST_F(Sheen, theTermsAreTheSources) {
    test::Random random(31);
    std::vector<TermsCase> cases;
    for (int i = 0; i < 50000; ++i) {
        TermsCase c;
        c.alpha = glm::vec2(float(random.logarithmic(ALPHA_MIN, 1.0)));
        c.h = glm::vec3(random.around({0, 0, 1}, 0.0, 1.0));
        c.cosine = float(random.logarithmic(1e-3, 1.0));
        cases.push_back(c);
    }
    const std::vector<LobeTerms> found = terms(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double alpha = double(cases[i].alpha.x), x = double(cases[i].cosine);
        const glm::dvec3 h = glm::normalize(glm::dvec3(cases[i].h)); // the exponent would amplify its rounding
        const double d = charlie(std::sqrt(h.x * h.x + h.y * h.y), alpha);
        // The exponent 1 / alpha, up to 1000, amplifies the rounding of the logarithm, which grows as the lobe darkens.
        ASSERT_NEAR(found[i].charlieD, d, 1e-5 * d + 1e-6 * charlie(1.0, alpha)) << "alpha " << alpha << " z " << h.z;
        const double v = 1.0 / ((1.0 + 2.0 * charlieLambda(x, alpha)) * 4.0 * x * x);
        // exp of up to 13 for these cosines: 13 roundings of 6e-8 and those of the fit.
        ASSERT_NEAR(found[i].charlieV, v, 3e-5 * v) << "alpha " << alpha << " cosine " << x;
    }
}

TEST_F(Sheen, theFittedAlbedoIsNearTheIntegral) {
    double worst = 0.0;
    for (const double roughness : {0.07, 0.1, 0.15, 0.25, 0.4, 0.55, 0.7, 0.9, 1.0}) {
        const double alpha = roughness * roughness;
        for (const double mu : {0.01, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9, 1.0}) {
            TermsCase c;
            c.alpha = glm::vec2(float(alpha));
            c.cosine = float(mu);
            // Where the lobe gains energy, as at grazing angles for small alpha, no light reaches the layers below.
            const double integral = std::min(1.0, sheenEnergy(mu, alpha, 256));
            const double error = std::abs(double(terms({c}).front().sheenAlbedo) - integral);
            EXPECT_LE(error, 0.035) << "roughness " << roughness << " mu " << mu; // the fit's error, measured
            worst = std::max(worst, error);
        }
    }
    EXPECT_GT(worst, 1e-4) << "the fit is compared with itself";
}

TEST_F(Sheen, clothNeverReflectsMoreThanArrivesUnlessItsHairsAreNearlyUpright) {
    constexpr int kSteps = 128;
    // From here on the lobe alone stays below 1 (the table in docs/numerics.md).
    for (const double roughness : {0.4, 0.6, 0.8, 1.0}) {
        for (const double mu : {0.1, 0.3, 0.6, 1.0}) {
            std::vector<LobeCase> cases;
            std::vector<double> weight;
            forLights(kSteps, [&](const glm::dvec3& l, double solidAngle) {
                LobeCase c;
                c.albedo = glm::vec3(1.0f);
                c.alpha = c.alphaBitangent = 1.0f;
                c.sheenColor = {1.0f, 0.5f, 0.0f};
                c.sheenAlpha = float(roughness * roughness);
                c.l = glm::vec3(l);
                c.v = glm::vec3(glm::dvec3(std::sqrt(1.0 - mu * mu), 0.0, mu));
                cases.push_back(c);
                weight.push_back(solidAngle);
            });
            const std::vector<LobeResult> results = run(cases);
            glm::dvec3 energy(0.0);
            for (std::size_t i = 0; i < weight.size(); ++i) energy += glm::dvec3(results[i].brdfCosine) * weight[i];
            // The error of the fit that scales the layers below.
            EXPECT_LE(energy.x, 1.0 + 0.035) << "roughness " << roughness << " mu " << mu;
            EXPECT_LT(energy.z, energy.x);
            EXPECT_LT(energy.z, energy.y) << "less sheen, less light: what lies below is darkened for all alike";
        }
    }
}

TEST_F(Sheen, aBlackSheenLeavesEveryBitAsItIs) {
    test::Random random(32);
    std::vector<LobeCase> cases;
    for (int i = 0; i < 20000; ++i) {
        LobeCase c = randomCase(random, unsigned(scenes::MaterialModel::MetallicRoughness));
        c.coatFactor = 0.0f;
        c.sheenColor = glm::vec3(0.0f);
        cases.push_back(c);
        c.sheenAlpha = 0.9f;
        c.coatAlpha = 0.9f;
        c.coatNormal = glm::vec3(0, 1, 0);
        cases.push_back(c);
    }
    const std::vector<LobeResult> results = run(cases);
    for (std::size_t i = 0; i < cases.size(); i += 2) ASSERT_EQ(results[i].brdfCosine, results[i + 1].brdfCosine);
}

using Clearcoat = test::LobeTest;

TEST_F(Clearcoat, aCoatLiesOverTheMaterialAsTheExtensionSays) {
    test::Random random(33);
    std::vector<LobeCase> cases;
    for (int i = 0; i < 20000; ++i) {
        LobeCase c = randomCase(random, unsigned(scenes::MaterialModel::MetallicRoughness));
        c.coatAlpha = float(random.logarithmic(0.05, 1.0));
        c.l = glm::vec3(random.around(glm::normalize(glm::dvec3(c.n)), -0.2, 1.0));
        c.v = glm::vec3(random.around(glm::normalize(glm::dvec3(c.n)), 0.0, 1.0));
        cases.push_back(c);
        c.coatFactor = 0.0f;
        cases.push_back(c);
    }
    const std::vector<LobeResult> results = run(cases);
    for (std::size_t i = 0; i < cases.size(); i += 2) {
        const LobeCase& c = cases[i];
        const glm::dvec3 n = glm::normalize(glm::dvec3(c.coatNormal)), l(c.l), v(c.v), h = glm::normalize(l + v);
        const double nl = glm::dot(n, l), nv = glm::dot(n, v), nh = glm::dot(n, h),
                     a2 = double(c.coatAlpha) * c.coatAlpha;
        double lobe = 0.0;
        if (nl > 0.0 && nv > 0.0) {
            // Appendix B of glTF 2.0: GGX and height-correlated Smith.
            const double t = nh * nh * (a2 - 1.0) + 1.0;
            const auto q = [&](double x) { return std::sqrt(a2 + (1.0 - a2) * x * x); };
            lobe = a2 / (test::pi * t * t) * 0.5 / (nl * q(nv) + nv * q(nl)) * nl;
        }
        const double fresnel = 0.04 + 0.96 * std::pow(1.0 - std::abs(nv), 5.0), weight = double(c.coatFactor) * fresnel;
        const double expected = double(results[i + 1].brdfCosine.y) * (1.0 - weight) + weight * lobe;
        // The coat's normal is stored in fp32 octahedral form with an error of 1e-7, which the lobe's slope multiplies
        // by 1/alpha.
        ASSERT_NEAR(results[i].brdfCosine.y, expected, 3e-5 * expected + 1e-6) << i;
    }
}

TEST_F(Clearcoat, aCoatIsLitByItsOwnNormal) {
    LobeCase c;
    c.coatFactor = 1.0f;
    c.coatAlpha = 0.2f;
    c.l = glm::normalize(glm::vec3(0.9f, 0.0f, -0.1f)); // behind the surface, in front of its coat
    c.v = glm::normalize(glm::vec3(0.3f, 0.0f, 1.0f));
    c.coatNormal = glm::normalize(c.l + c.v);
    EXPECT_GT(run(c).brdfCosine.x, 0.0f);
    c.coatNormal = {0, 0, 1};
    EXPECT_EQ(run(c).brdfCosine, glm::vec3(0.0f));
}

} // namespace
} // namespace tessera
