// Lobes with a direction, an exponent or fibres, and the layers: edges of their domain, and properties of all models.
#include <gtest/gtest.h>

#include "tests/gpu/shaders/LobeBench.h"

namespace tessera {
namespace {

using test::LobeCase;
using test::LobeResult;
using test::LobeTerms;
using test::TermsCase;

using Lobes = test::LobeTest;

constexpr unsigned kGlossy[] = {
    unsigned(scenes::MaterialModel::BlinnPhong), unsigned(scenes::MaterialModel::Microfacet),
    unsigned(scenes::MaterialModel::MicrofacetAnisotropic), unsigned(scenes::MaterialModel::MetallicRoughness)};

TEST_F(Lobes, aRandomSurfaceOfAnyModelAndLayerIsNotNaNInfiniteOrNegative) {
    constexpr int kBatch = 1 << 18;
    test::Random random(14);
    for (const unsigned model :
         {unsigned(scenes::MaterialModel::Lambert), unsigned(scenes::MaterialModel::BlinnPhong),
          unsigned(scenes::MaterialModel::Microfacet), unsigned(scenes::MaterialModel::MicrofacetAnisotropic),
          unsigned(scenes::MaterialModel::MetallicRoughness)}) {
        for (int batch = 0; batch < 4; ++batch) {
            std::vector<LobeCase> cases;
            cases.reserve(kBatch);
            for (int i = 0; i < kBatch; ++i) cases.push_back(randomCase(random, model));
            const std::vector<LobeResult> results = run(cases);
            int lit = 0;
            for (std::size_t i = 0; i < results.size(); ++i) {
                const LobeResult& r = results[i];
                ASSERT_TRUE(isFiniteAndPositive(r.brdfCosine)) << "model " << model << " sample " << i;
                // 1e20 is the brightest light that the specification requires.
                ASSERT_TRUE(isFiniteAndPositive(r.brdfCosine * 1e20f)) << "model " << model << " sample " << i;
                ASSERT_TRUE(isFiniteAndPositive({r.d, r.v, r.f})) << "model " << model << " sample " << i;
                lit += r.brdfCosine.x > 0.0f;
            }
            EXPECT_GT(lit, kBatch / 4); // nearly half of the lights are above the surface
        }
    }
}

TEST_F(Lobes, specularAloneIsReciprocalWithAndWithoutADirection) {
    test::Random random(15);
    std::vector<LobeCase> cases;
    for (int i = 0; i < 100000; ++i) {
        LobeCase c = randomCase(random, i % 2 == 0 ? unsigned(scenes::MaterialModel::MicrofacetAnisotropic)
                                                   : unsigned(scenes::MaterialModel::MetallicRoughness));
        c.iorOrF90 = i % 2 == 0 ? float(random.between(1.1, 3.0)) : 1.0f;
        c.alpha = float(random.logarithmic(0.01, 1.0));
        c.alphaBitangent = float(random.logarithmic(0.01, 1.0));
        // Above 0.05, so |l + v| >= 0.1 and h keeps its digits; below, l.h and v.h differ by the rounding of h alone.
        const glm::dvec3 n = glm::normalize(glm::dvec3(c.n));
        c.l = glm::vec3(random.around(n, 0.05, 1.0));
        c.v = glm::vec3(random.around(n, 0.05, 1.0));
        cases.push_back(c);
        std::swap(c.l, c.v);
        cases.push_back(c);
    }
    const std::vector<LobeResult> results = run(cases);
    for (std::size_t i = 0; i < cases.size(); i += 2) {
        const double there = double(results[i].d) * results[i].v * results[i].f;
        const double back = double(results[i + 1].d) * results[i + 1].v * results[i + 1].f;
        ASSERT_GT(there, 0.0);
        ASSERT_NEAR(there, back, 1e-5 * there) << "sample " << i;
    }
}

TEST_F(Lobes, blinnPhongEqualsThePowerOfTheCosine) {
    test::Random random(16);
    std::vector<TermsCase> cases;
    for (int i = 0; i < 200000; ++i) {
        TermsCase c;
        c.n = glm::vec3(random.direction());
        c.exponent = float(random.logarithmic(0.01, 1e5));
        // Most where the highlight is not yet dark: cos^p = e^-8 at an angle of 4 / sqrt p.
        const double angle = std::min(1.5, random.unit() * 4.0 / std::sqrt(double(c.exponent)));
        c.h = glm::vec3(random.around(glm::normalize(glm::dvec3(c.n)), std::cos(angle), std::cos(angle)));
        cases.push_back(c);
    }
    const std::vector<LobeTerms> found = terms(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const glm::dvec3 n = glm::normalize(glm::dvec3(cases[i].n)), h = glm::normalize(glm::dvec3(cases[i].h));
        const double cosine = glm::dot(n, h), p = double(cases[i].exponent);
        const double sine2 = glm::dot(glm::cross(n, h), glm::cross(n, h));
        const double expected = std::exp(0.5 * p * std::log1p(-std::min(sine2, 1.0 - 1e-12)));
        // |n x h|^2 is accurate to 4e-7 / angle, times p angle^2 / 2: 2e-7 p angle <= 8e-7 sqrt p. Beyond 30 degrees
        // the error of the cosine, 1.5e-7, counts too, relatively more the smaller the cosine is.
        const double allowed = 3e-6 + 1e-6 * std::sqrt(p) + (sine2 > 0.2499 ? 3e-7 * p / cosine : 0.0);
        ASSERT_NEAR(found[i].blinnPhong, expected, allowed * expected) << "p " << p << " sine^2 " << sine2;
    }
}

TEST_F(Lobes, noMicrofacetFacesAlongTheHorizon) {
    // chi+ of Walter 2007, eq. 33, is 0 at a cosine of exactly 0 too, where the rest of D would be 1 / pi for alpha 1.
    TermsCase c;
    c.alpha = glm::vec2(1.0f);
    c.h = {1, 0, 0};
    EXPECT_EQ(terms({c}).front().isotropicD, 0.0f);
    EXPECT_EQ(terms({c}).front().anisotropicD, 0.0f);
}

TEST_F(Lobes, anyCosineToThePowerOfZeroIsExactlyOne) {
    for (const float angle : {0.0f, 0.5f, 1.5f, 1.5707963f}) {
        TermsCase c;
        c.exponent = 0.0f;
        c.h = {std::sin(angle), 0.0f, std::cos(angle)};
        EXPECT_EQ(terms({c}).front().blinnPhong, 1.0f) << angle;
    }
    TermsCase aside;
    aside.exponent = 0.0f;
    aside.h = {1, 0, 0};
    EXPECT_EQ(terms({aside}).front().blinnPhong, 1.0f);
    aside.exponent = 0.5f;
    EXPECT_EQ(terms({aside}).front().blinnPhong, 0.0f);
}

TEST_F(Lobes, blinnPhongIsExactlyItsDiffuseAndSpecularPartsByHand) {
    LobeCase c;
    c.model = unsigned(scenes::MaterialModel::BlinnPhong);
    c.albedo = {0.5f, 0.25f, 0.0f};
    c.specular = {0.25f, 0.5f, 1.0f};
    c.exponent = 2.0f;
    c.l = {0.6f, 0.0f, 0.8f};
    c.v = {-0.6f, 0.0f, 0.8f};
    // h = n: the highlight is 1, without a cosine.
    const glm::vec3 peak = run(c).brdfCosine;
    EXPECT_NEAR(peak.x, 0.5 * 0.8 + 0.25, 1e-6);
    EXPECT_NEAR(peak.y, 0.25 * 0.8 + 0.5, 1e-6);
    EXPECT_NEAR(peak.z, 1.0, 1e-6);
    c.v = {0.6f, 0.0f, -0.8f}; // viewed from below, only the diffuse part remains
    EXPECT_NEAR(run(c).brdfCosine.x, 0.5 * 0.8, 1e-6);
    EXPECT_EQ(run(c).brdfCosine.z, 0.0f);
    c.l = {0.6f, 0.0f, -0.8f};
    EXPECT_EQ(run(c).brdfCosine, glm::vec3(0.0f));
}

TEST_F(Lobes, theHalfVectorMaskingIsThatOfTheHandout) {
    test::Random random(17);
    std::vector<LobeCase> cases;
    for (int i = 0; i < 20000; ++i) {
        LobeCase c;
        c.model = unsigned(scenes::MaterialModel::Microfacet);
        c.masking = MASKING_HALF_VECTOR;
        c.iorOrF90 = 1.5f;
        c.alpha = float(random.logarithmic(0.05, 1.0));
        c.l = glm::vec3(random.around({0, 0, 1}, 0.01, 1.0));
        c.v = glm::vec3(random.around({0, 0, 1}, 0.01, 1.0));
        cases.push_back(c);
    }
    const std::vector<LobeResult> results = run(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        // Normalised in double: near l = -v, l.h and v.h of fp32 vectors differ from each other.
        const glm::dvec3 l = glm::normalize(glm::dvec3(cases[i].l)), v = glm::normalize(glm::dvec3(cases[i].v));
        const double c = glm::dot(l, glm::normalize(l + v)), tan2 = (1.0 - c * c) / (c * c),
                     alpha = double(cases[i].alpha);
        const double g1 = 2.0 / (1.0 + std::sqrt(1.0 + alpha * alpha * tan2));
        const double expected = g1 * g1 / (4.0 * l.z * v.z);
        ASSERT_NEAR(results[i].v, expected, 3e-6 * expected); // a dozen roundings
    }
    LobeCase grazing = cases.front();
    grazing.l = {0, 0, 1};
    grazing.v = {1.0f, 0.0f, 1e-7f};
    const double held = double(run(grazing).v), c = std::sqrt(0.5), alpha = double(grazing.alpha);
    const double g1 = 2.0 / (1.0 + std::sqrt(1.0 + alpha * alpha * (1.0 / (c * c) - 1.0)));
    EXPECT_NEAR(held * 4e-6 / (g1 * g1), 1.0, 1e-5) << "n.v is held to 1e-6";
}

} // namespace
} // namespace tessera
