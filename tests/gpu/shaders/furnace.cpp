// Energy and normalisation of the microfacet terms: the shader's D and V at fp32, summed in double.
#include <gtest/gtest.h>

#include "shaders/shared/models.h"
#include "tests/gpu/shaders/LobeBench.h"
#include "tests/gpu/shaders/Quadrature.h"

namespace tessera {
namespace {

constexpr int kFurnacePsiSteps = 384;
constexpr int kFurnacePhiSteps = 96;
// The midpoint rule's error at these steps, measured against 4 times as many: 1.0e-4 where mu = 0.02 and grazing half
// vectors cut the lobe, below 2e-5 from mu = 0.1 on.
constexpr double kQuadrature = 2e-5;
constexpr double kQuadratureGrazing = 2e-4;

struct Furnace {
    double normalisation = 0.0; ///< integral of D n.h over the hemisphere
    double weak = 0.0;          ///< integral of D G1(v) / (4 n.v) over the sphere of l
    double separable = 0.0;     ///< directional albedo with F = 1
    double correlated = 0.0;
};

class FurnaceTest : public test::GlTest {
protected:
    Furnace furnace(double mu, double alphaWanted) {
        const double alpha = float(alphaWanted);
        const glm::dvec3 v(std::sqrt(1.0 - mu * mu), 0.0, mu);
        std::vector<glm::vec4> inputs;
        std::vector<double> solidAngle, sinkLight, sinkSphere;
        test::forHalfVectors(alpha, kFurnacePsiSteps, kFurnacePhiSteps, [&](const test::HalfVector& half) {
            const double vh = glm::dot(v, half.h);
            const double nl = 2.0 * vh * half.h.z - mu;
            inputs.insert(
                inputs.end(),
                {{0, 0, 1, float(alpha)}, {glm::vec3(half.h), float(std::max(nl, 0.0))}, {float(mu), 1, 1, 0}});
            solidAngle.push_back(half.weight * half.h.z);
            sinkSphere.push_back(half.weight * 4.0 * std::max(vh, 0.0));
            sinkLight.push_back(half.weight * 4.0 * std::max(vh, 0.0) * std::max(nl, 0.0));
        });
        const std::size_t count = solidAngle.size();
        const std::vector<glm::vec4> terms = bench.run("stress/terms.comp", {}, inputs, count, 2);
        // G1(v) / (4 n.v) is the separable term of a light along n, whose own masking is 1.
        const float smith = float(mu);
        const std::vector<glm::vec4> facing =
            bench.run("stress/terms.comp", {}, {{0, 0, 1, float(alpha)}, {0, 0, 1, 1}, {smith, 1, 1, 0}}, 1, 2);
        Furnace sum;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec4 t(terms[2 * i]);
            sum.normalisation += t.x * solidAngle[i];
            sum.weak += t.x * double(facing[0].y) * sinkSphere[i];
            sum.separable += t.x * t.y * sinkLight[i];
            sum.correlated += t.x * t.z * sinkLight[i];
        }
        return sum;
    }
    test::ShaderBench bench;
};

TEST_F(FurnaceTest, theDistributionIntegratesToOne) {
    // fp32 D is accurate to 1e-4 at alpha 0.002 and to twice that at the minimum of 0.001; its errors have both signs
    // and average out.
    for (const double alpha : {0.001, 0.002, 0.01, 0.05, 0.3, 1.0})
        EXPECT_NEAR(furnace(0.5, alpha).normalisation, 1.0, kQuadrature) << "alpha " << alpha;
}

TEST_F(FurnaceTest, theWeakWhiteFurnaceIsOneOverTheSphere) {
    for (const double mu : {0.1, 0.25, 0.5, 0.75, 1.0})
        for (const double alpha : {0.05, 0.1, 0.25, 0.5, 1.0})
            EXPECT_NEAR(furnace(mu, alpha).weak, 1.0, 5.0 * kQuadrature) << "mu " << mu << " alpha " << alpha;
}

TEST_F(FurnaceTest, reflectedEnergyNeverExceedsWhatArrives) {
    for (const double mu : {0.02, 0.1, 0.3, 0.6, 0.9, 1.0}) {
        for (const double alpha : {0.001, 0.01, 0.1, 0.3, 0.6, 1.0}) {
            const Furnace sum = furnace(mu, alpha);
            EXPECT_LE(sum.separable, 1.0 + kQuadratureGrazing) << "mu " << mu << " alpha " << alpha;
            EXPECT_LE(sum.correlated, 1.0 + kQuadratureGrazing) << "mu " << mu << " alpha " << alpha;
            // Heitz 2014: correlated masking hides less than separable.
            EXPECT_GE(sum.correlated, sum.separable - 1e-6) << "mu " << mu << " alpha " << alpha;
        }
    }
}

TEST_F(FurnaceTest, correlatedEnergyIsExactlyTheTabulatedOne) {
    constexpr double kMu[] = {0.1, 0.25, 0.5, 0.75, 1.0};
    constexpr double kAlpha[] = {0.05, 0.1, 0.25, 0.5, 0.75, 1.0};
    constexpr double kEnergy[5][6] = {{.9113, .8834, .8916, .8601, .8107, .7602},
                                      {.9745, .9216, .8401, .7652, .6802, .5976},
                                      {.9927, .9692, .8572, .6982, .5646, .4507},
                                      {.9961, .9831, .8915, .6821, .5014, .3645},
                                      {.9973, .9882, .9158, .6879, .4639, .3069}};
    for (std::size_t m = 0; m < 5; ++m) {
        for (std::size_t a = 0; a < 6; ++a) {
            // The table is accurate to 2e-4.
            EXPECT_NEAR(furnace(kMu[m], kAlpha[a]).correlated, kEnergy[m][a], 2e-4 + kQuadrature)
                << "mu " << kMu[m] << " alpha " << kAlpha[a];
        }
    }
}

/// Both sums of the split-sum approximation: A weights F0, B is Schlick's second term. F comes from the shader too;
/// with F0 = 0 it is (1 - v.h)^5.
TEST_F(FurnaceTest, splitSumsAreExactlyThoseOfTheTable) {
    constexpr double kMu[] = {0.1, 0.5, 1.0};
    constexpr double kRoughness[] = {0.25, 0.5, 0.75, 1.0};
    constexpr double kA[3][4] = {
        {.5051, .7519, .7958, .7363}, {.9557, .8349, .6547, .4477}, {.9957, .9158, .6268, .3067}};
    constexpr double kB[3][4] = {
        {.3916, .1397, .0526, .0239}, {.0326, .0223, .0085, .0030}, {.0000, .0000, .0000, .0000}};
    for (std::size_t m = 0; m < 3; ++m) {
        for (std::size_t r = 0; r < 4; ++r) {
            const double mu = kMu[m];
            const auto alpha = float(kRoughness[r] * kRoughness[r]);
            const glm::dvec3 v(std::sqrt(1.0 - mu * mu), 0.0, mu);
            std::vector<glm::vec4> inputs;
            std::vector<double> weight;
            test::forHalfVectors(double(alpha), kFurnacePsiSteps, kFurnacePhiSteps, [&](const test::HalfVector& half) {
                const double vh = glm::dot(v, half.h), nl = 2.0 * vh * half.h.z - mu;
                if (vh <= 0.0 || nl <= 0.0) return;
                weight.push_back(half.weight * 4.0 * vh * nl);
                inputs.insert(inputs.end(),
                              {{0, 0, 1, alpha}, {glm::vec3(half.h), float(nl)}, {float(mu), 1, float(vh), 0}});
            });
            const std::vector<glm::vec4> terms = bench.run("stress/terms.comp", {}, inputs, weight.size(), 2);
            double a = 0.0, b = 0.0;
            for (std::size_t i = 0; i < weight.size(); ++i) {
                const glm::dvec4 t(terms[2 * i]);
                const double fresnel = double(terms[2 * i + 1].x);
                a += t.x * t.z * (1.0 - fresnel) * weight[i];
                b += t.x * t.z * fresnel * weight[i];
            }
            // The table's last digit, and the rule's error.
            EXPECT_NEAR(a, kA[m][r], 3e-4) << "mu " << mu << " roughness " << kRoughness[r];
            EXPECT_NEAR(b, kB[m][r], 3e-4) << "mu " << mu << " roughness " << kRoughness[r];
        }
    }
}

TEST_F(FurnaceTest, atAlphaOneBothFormsAreExactlyTheirClosedForms) {
    for (const double mu : {0.1, 0.25, 0.5, 0.75, 1.0}) {
        const Furnace sum = furnace(mu, 1.0);
        EXPECT_NEAR(sum.correlated, 1.0 - mu * std::log1p(1.0 / mu), kQuadrature) << "mu " << mu;
        EXPECT_NEAR(sum.separable, 2.0 * (1.0 - std::log(2.0)) / (1.0 + mu), kQuadrature) << "mu " << mu;
    }
}

using WhiteFurnace = test::LobeTest;

TEST_F(WhiteFurnace, aWhiteMetalNeverReflectsMoreThanArrivesAndExactlyItsClosedFormAtAlphaOne) {
    // The whole computation, from directions to radiance: base colour 1, metallic 1, so F = 1 and no diffuse part.
    for (const double mu : {0.1, 0.5, 0.9}) {
        for (const double alpha : {0.05, 0.3, 1.0}) {
            const glm::dvec3 v(std::sqrt(1.0 - mu * mu), 0.0, mu);
            std::vector<test::LobeCase> cases;
            std::vector<double> weight;
            test::forHalfVectors(float(alpha), kFurnacePsiSteps, kFurnacePhiSteps, [&](const test::HalfVector& half) {
                const double vh = glm::dot(v, half.h);
                if (vh <= 0.0) return;
                const glm::vec3 l(2.0 * vh * half.h - v);
                weight.push_back(half.weight * 4.0 * vh);
                cases.push_back({.albedo = glm::vec3(1.0f),
                                 .metallic = 1.0f,
                                 .alpha = float(alpha),
                                 .l = l,
                                 .v = glm::vec3(v),
                                 .alphaBitangent = float(alpha)});
            });
            const std::vector<test::LobeResult> out = run(cases);
            double energy = 0.0;
            for (std::size_t i = 0; i < weight.size(); ++i) energy += double(out[i].brdfCosine.y) * weight[i];
            EXPECT_LE(energy, 1.0) << "mu " << mu << " alpha " << alpha;
            EXPECT_GT(energy, 0.2) << "mu " << mu << " alpha " << alpha;
            if (alpha == 1.0) {
                EXPECT_NEAR(energy, 1.0 - mu * std::log1p(1.0 / mu), kQuadrature) << "mu " << mu;
            }
        }
    }
}

} // namespace
} // namespace tessera
