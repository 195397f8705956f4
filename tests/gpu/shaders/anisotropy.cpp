// The lobe with two alphas: the shader's terms at fp32 compared with double, and with theory.
#include <numbers>

#include <gtest/gtest.h>

#include "tests/gpu/shaders/LobeBench.h"
#include "tests/gpu/shaders/Quadrature.h"

namespace tessera {
namespace {

using test::LobeCase;
using test::LobeResult;
using test::LobeTerms;
using test::TermsCase;

class Anisotropy : public test::LobeTest {
protected:
    /// Half vectors of a lobe with two alphas: the isotropic ones of alpha 1 with stretched slopes. `weight` is the
    /// solid angle of each.
    static std::vector<test::HalfVector> halfVectors(const glm::dvec2& alpha, int psiSteps, int phiSteps) {
        std::vector<test::HalfVector> result;
        // Both halves of the turn; forHalfVectors() visits one.
        for (const double side : {1.0, -1.0}) {
            test::forHalfVectors(1.0, psiSteps, phiSteps, [&](const test::HalfVector& unit) {
                const glm::dvec2 slope = glm::dvec2(unit.h.x, side * unit.h.y) / unit.h.z * alpha;
                const double cosine = 1.0 / std::sqrt(1.0 + glm::dot(slope, slope));
                // d(solid angle) = cos^3 d(slopes), and slopes are stretched by the product of the alphas.
                const double stretched = std::pow(cosine / unit.h.z, 3) * alpha.x * alpha.y;
                result.push_back({{slope.x * cosine, slope.y * cosine, cosine}, 0.5 * unit.weight * stretched});
            });
        }
        return result;
    }
};

constexpr glm::vec2 kAlphas[] = {{0.5f, 0.5f}, {0.1f, 0.6f}, {0.9f, 0.02f}, {0.005f, 0.3f}, {1.0f, 0.2f}};
// Steps of the midpoint rule, whose error is given in furnace.cpp.
constexpr int kPsiSteps = 256;
constexpr int kPhiSteps = 96;

TEST_F(Anisotropy, theDistributionIntegratesToOne) {
    for (const glm::vec2 alpha : kAlphas) {
        const std::vector<test::HalfVector> halves = halfVectors(alpha, kPsiSteps, kPhiSteps);
        std::vector<TermsCase> cases;
        for (const test::HalfVector& half : halves) {
            TermsCase c;
            c.alpha = alpha;
            c.h = glm::vec3(half.h);
            cases.push_back(c);
        }
        const std::vector<LobeTerms> found = terms(cases);
        double sum = 0.0;
        for (std::size_t i = 0; i < halves.size(); ++i)
            sum += double(found[i].anisotropicD) * halves[i].h.z * halves[i].weight;
        EXPECT_NEAR(sum, 1.0, 2e-5) << alpha.x << " " << alpha.y;
    }
}

TEST_F(Anisotropy, theWeakWhiteFurnaceOfDirectionalMaskingIsOneOverTheSphere) {
    for (const glm::vec2 alpha : {glm::vec2(0.1f, 0.6f), glm::vec2(0.9f, 0.2f)}) {
        const std::vector<test::HalfVector> halves = halfVectors(alpha, kPsiSteps, 2 * kPhiSteps);
        for (const double turn : {0.0, 0.6, 1.5}) {
            for (const double mu : {0.2, 0.6, 1.0}) {
                const double sine = std::sqrt(1.0 - mu * mu);
                const glm::dvec3 v(sine * std::cos(turn), sine * std::sin(turn), mu);
                std::vector<TermsCase> cases;
                for (const test::HalfVector& half : halves) {
                    TermsCase c;
                    c.alpha = alpha;
                    c.h = glm::vec3(half.h);
                    c.direction = glm::vec3(v);
                    cases.push_back(c);
                }
                const std::vector<LobeTerms> found = terms(cases);
                double sum = 0.0;
                for (std::size_t i = 0; i < halves.size(); ++i) {
                    // dl = 4 v.h dh; G1(v) / (4 n.v) = 1 / (2 (n.v + q)).
                    const double dl = 4.0 * std::max(glm::dot(v, halves[i].h), 0.0) * halves[i].weight;
                    sum += double(found[i].anisotropicD) / (2.0 * (mu + double(found[i].smithLength))) * dl;
                }
                // The clamp at v.h = 0 cuts the lobe between grid points, more of it at low mu: a few steps of 1/256
                // squared.
                EXPECT_NEAR(sum, 1.0, 3e-4) << alpha.x << " " << alpha.y << " mu " << mu << " turn " << turn;
            }
        }
    }
}

TEST_F(Anisotropy, equalAlphasAreTheIsotropicLobe) {
    test::Random random(21);
    std::vector<TermsCase> cases;
    for (int i = 0; i < 200000; ++i) {
        TermsCase c;
        c.alpha = glm::vec2(float(random.logarithmic(0.002, 1.0)));
        c.n = glm::vec3(random.direction());
        const glm::dvec3 n = glm::normalize(glm::dvec3(c.n));
        const double theta = std::atan(double(c.alpha.x) * std::tan(0.49 * test::pi * random.unit()));
        c.h = glm::vec3(random.around(n, std::cos(theta), std::cos(theta)));
        c.tangent = glm::vec3(random.around(n, 0.0, 0.0));
        c.direction = glm::vec3(random.around(n, 0.01, 1.0));
        cases.push_back(c);
    }
    const std::vector<LobeTerms> found = terms(cases);
    double worst = 0.0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const LobeTerms& t = found[i];
        worst = std::max(worst, std::abs(double(t.anisotropicD) / t.isotropicD - 1.0));
        const double cosine = glm::dot(glm::dvec3(cases[i].n), glm::dvec3(cases[i].direction));
        const double alpha = double(cases[i].alpha.x);
        const double q = std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine);
        ASSERT_NEAR(t.smithLength, q, 1e-6) << i;
        ASSERT_NEAR(t.alphaAlong, alpha, 1e-6 * alpha) << i;
    }
    EXPECT_LE(worst, 2e-6) << "twice 1e-6: t enters squared";
}

TEST_F(Anisotropy, aSurfaceOfEqualAlphasReflectsLikeTheIsotropicModel) {
    test::Random random(22);
    std::vector<LobeCase> cases;
    while (cases.size() < 100000) {
        LobeCase c = randomCase(random, unsigned(scenes::MaterialModel::MicrofacetAnisotropic));
        c.alphaBitangent = c.alpha = float(random.logarithmic(0.01, 1.0));
        c.iorOrF90 = float(random.between(1.1, 3.0));
        c.specular = glm::vec3(1.0f);
        cases.push_back(c);
        c.model = unsigned(scenes::MaterialModel::Microfacet);
        if (c.masking == MASKING_DIRECTIONAL) c.masking = MASKING_WALTER;
        cases.push_back(c);
    }
    const std::vector<LobeResult> results = run(cases);
    for (std::size_t i = 0; i < cases.size(); i += 2) {
        const double anisotropic = double(results[i].brdfCosine.x), isotropic = double(results[i + 1].brdfCosine.x);
        // 1e-6 of the terms, doubled by the square in D; 1e-6 absolute where light grazes.
        ASSERT_NEAR(anisotropic, isotropic, 4e-6 * isotropic + 1e-6) << i;
    }
}

TEST_F(Anisotropy, theDistributionKeepsItsDigitsAtSmallAlpha) {
    test::Random random(23);
    std::vector<TermsCase> cases;
    std::vector<double> expected;
    for (int i = 0; i < 200000; ++i) {
        TermsCase c;
        c.alpha = {float(random.logarithmic(0.01, 1.0)), 0.01f};
        c.n = glm::vec3(random.direction());
        const glm::dvec3 n = glm::normalize(glm::dvec3(c.n));
        c.tangent = glm::vec3(random.around(n, 0.0, 0.0));
        const glm::dvec3 t(c.tangent), b = glm::cross(n, t);
        const double psi = std::tan(0.45 * test::pi * random.unit()), phi = 2.0 * test::pi * random.unit();
        c.h = glm::vec3(glm::normalize(n + t * (psi * std::cos(phi) * double(c.alpha.x)) +
                                       b * (psi * std::sin(phi) * double(c.alpha.y))));
        const glm::dvec3 nf(c.n), hf(c.h), across = glm::cross(nf, hf);
        const double along = glm::dot(across, glm::cross(nf, t)) / double(c.alpha.x);
        const double beside = glm::dot(across, t) / double(c.alpha.y), cosine = glm::dot(nf, hf);
        const double s = cosine * cosine + along * along + beside * beside;
        expected.push_back(1.0 / (test::pi * double(c.alpha.x) * double(c.alpha.y) * s * s));
        cases.push_back(c);
    }
    const std::vector<LobeTerms> found = terms(cases);
    double worst = 0.0;
    for (std::size_t i = 0; i < cases.size(); ++i)
        worst = std::max(worst, std::abs(double(found[i].anisotropicD) / expected[i] - 1.0));
    // Like the isotropic form at alpha 0.01: n x h cancels to about alpha, so its relative error in fp32 is 6e-8 /
    // alpha. Where the other alpha is large, components of that size are divided by the small alpha.
    EXPECT_LE(worst, 1e-4);
}

TEST_F(Anisotropy, aMicrofacetAlongTheNormalHasTheMeanAlpha) {
    const float mean = std::sqrt(0.5f * (0.04f + 0.64f));
    TermsCase c;
    c.alpha = {0.2f, 0.8f};
    EXPECT_NEAR(terms({c}).front().alphaAlong, mean, 1e-7);
    // Nearly along the normal, as far as fp32 can represent it: the squares of these components underflow.
    for (const float tiny : {1e-16f, 1e-22f, 1e-30f, 1e-38f}) {
        c.h = {tiny, 0.0f, 1.0f};
        EXPECT_NEAR(terms({c}).front().alphaAlong, mean, 1e-7) << tiny;
    }
    c.h = {1e-7f, 0.0f, 1.0f};
    EXPECT_NEAR(terms({c}).front().alphaAlong, 0.2f, 1e-7);
    c.h = {0.0f, 1e-7f, 1.0f};
    EXPECT_NEAR(terms({c}).front().alphaAlong, 0.8f, 1e-7);
}

/// From straight above all microfacets are visible: their slopes have the length sqrt(u / (1 - u)) in units of the
/// alphas (Walter 2007, eq. 35), and turn by 2 pi v from the tangent.
TEST_F(Anisotropy, sampledMicrofacetsSeenFromStraightAboveHaveTheSlopesOfTheirDistribution) {
    std::vector<glm::vec4> inputs;
    for (const glm::vec2 alpha : kAlphas)
        for (const float u : {0.01f, 0.25f, 0.5f, 0.9f})
            for (int i = 0; i < 16; ++i) inputs.push_back({u, float(i) / 16.0f, alpha});
    test::ShaderBench bench;
    const std::vector<glm::vec4> found = bench.run("test/visible_facets.comp", {}, inputs, inputs.size(), 1);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const double u = double(inputs[i].x), turn = 2.0 * std::numbers::pi * double(inputs[i].y);
        const double length = std::sqrt(u / (1.0 - u));
        const glm::dvec3 half = glm::dvec3(found[i]) + glm::dvec3(0.0, 0.0, 1.0);
        EXPECT_NEAR(half.x / half.z, double(inputs[i].z) * length * std::cos(turn), 1e-4 * length) << i;
        EXPECT_NEAR(half.y / half.z, double(inputs[i].w) * length * std::sin(turn), 1e-4 * length) << i;
    }
}

TEST_F(Anisotropy, reflectedEnergyNeverExceedsWhatArrives) {
    for (const glm::vec2 alpha : {glm::vec2(0.1f, 0.6f), glm::vec2(0.9f, 0.2f)}) {
        const std::vector<test::HalfVector> halves = halfVectors(alpha, kPsiSteps, 2 * kPhiSteps);
        for (const unsigned model : {unsigned(scenes::MaterialModel::MetallicRoughness),
                                     unsigned(scenes::MaterialModel::MicrofacetAnisotropic)}) {
            for (const double mu : {0.1, 0.5, 1.0}) {
                for (const double turn : {0.0, 0.8, 1.57}) {
                    const double sine = std::sqrt(1.0 - mu * mu);
                    const glm::dvec3 v(sine * std::cos(turn), sine * std::sin(turn), mu);
                    std::vector<LobeCase> cases;
                    std::vector<double> weight;
                    for (const test::HalfVector& half : halves) {
                        const double vh = glm::dot(v, half.h);
                        if (vh <= 0.0) continue;
                        LobeCase c;
                        c.model = model;
                        const bool metal = model == unsigned(scenes::MaterialModel::MetallicRoughness);
                        c.albedo = glm::vec3(metal ? 1.0f : 0.0f); // F = 1
                        c.metallic = metal ? 1.0f : 0.0f;
                        c.specular = glm::vec3(1.0f);
                        c.iorOrF90 = metal ? 1.0f : 1e6f; // reflects all but 4e-6
                        c.masking = MASKING_DIRECTIONAL;
                        c.alpha = alpha.x;
                        c.alphaBitangent = alpha.y;
                        c.v = glm::vec3(v);
                        c.l = glm::vec3(2.0 * vh * half.h - v);
                        cases.push_back(c);
                        weight.push_back(4.0 * vh * half.weight);
                    }
                    const std::vector<LobeResult> results = run(cases);
                    double energy = 0.0;
                    for (std::size_t i = 0; i < weight.size(); ++i)
                        energy += double(results[i].brdfCosine.x) * weight[i];
                    EXPECT_LE(energy, 1.0 + 2e-4) << "model " << model << " mu " << mu << " turn " << turn;
                    EXPECT_GT(energy, 0.3) << "model " << model << " mu " << mu << " turn " << turn;
                }
            }
        }
    }
}

} // namespace
} // namespace tessera
