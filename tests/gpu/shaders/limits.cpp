// layeredBrdfCosine and specularTerms at the edges of their domain.
#include <gtest/gtest.h>

#include "tests/gpu/shaders/LobeBench.h"

namespace tessera {
namespace {

using test::LobeCase;
using test::LobeResult;

using LimitsTest = test::LobeTest;

TEST_F(LimitsTest, aBlackMicrofacetSurfaceReflectsExactlyItsSpecularTerms) {
    test::Random random(6);
    std::vector<LobeCase> cases;
    for (int i = 0; i < 20000; ++i) {
        cases.push_back(bare(randomCase(random, unsigned(scenes::MaterialModel::Microfacet))));
        cases.back().albedo = glm::vec3(0.0f);
        cases.back().specular = glm::vec3(1.0f);
    }
    const std::vector<LobeResult> results = run(cases);
    for (const LobeResult& r : results) {
        const float expected = r.nl > 0.0f ? r.f * (r.d * r.v) * r.nl : 0.0f;
        ASSERT_EQ(r.brdfCosine.x, expected);
    }
}

TEST_F(LimitsTest, specularIsExactlyZeroWhereItsDirectionsHaveNoLobe) {
    const glm::vec3 up(0, 0, 1), side(1, 0, 0), slant(0.6f, 0.0f, 0.8f), below(0.6f, 0.0f, -0.8f);
    // Both above the horizon, by a cosine whose square underflows in fp32.
    const glm::vec3 hair(1.0f, 0.0f, 1e-25f), hairOpposite(-1.0f, 0.0f, 1e-25f);
    for (const unsigned model :
         {unsigned(scenes::MaterialModel::Microfacet), unsigned(scenes::MaterialModel::MetallicRoughness)}) {
        for (const float alpha : {float(ALPHA_MIN), 0.1f, 1.0f}) {
            std::vector<LobeCase> cases;
            for (const auto& [l, v] : {std::pair(side, up), std::pair(up, side), std::pair(side, side),
                                       std::pair(slant, -slant), std::pair(below, up), std::pair(slant, below),
                                       std::pair(side, -side), std::pair(up, -up), std::pair(hair, hairOpposite)}) {
                LobeCase c;
                c.model = model;
                c.alpha = alpha;
                c.iorOrF90 = model == unsigned(scenes::MaterialModel::Microfacet) ? 1.5f : 1.0f;
                c.specular = glm::vec3(model == unsigned(scenes::MaterialModel::Microfacet) ? 1.0f : 0.04f);
                c.l = l;
                c.v = v;
                cases.push_back(c);
            }
            const std::vector<LobeResult> results = run(cases);
            for (std::size_t i = 0; i < results.size(); ++i) {
                EXPECT_EQ(results[i].d * results[i].v, 0.0f)
                    << "model " << model << " alpha " << alpha << " case " << i;
                EXPECT_TRUE(isFiniteAndPositive(results[i].brdfCosine))
                    << "model " << model << " alpha " << alpha << " case " << i;
                if (!(results[i].nl > 0.0f)) {
                    EXPECT_EQ(results[i].brdfCosine, glm::vec3(0.0f));
                }
            }
            // Diffuse reflection needs only n.l > 0: light along the normal, viewed from the horizon.
            EXPECT_GT(results[1].brdfCosine.x, 0.0f);
        }
    }
}

TEST_F(LimitsTest, lambertIsItsColourTimesTheCosine) {
    test::Random random(7);
    std::vector<LobeCase> cases;
    for (int i = 0; i < 20000; ++i) cases.push_back(bare(randomCase(random, unsigned(scenes::MaterialModel::Lambert))));
    const std::vector<LobeResult> results = run(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double nl = glm::dot(glm::dvec3(cases[i].n), glm::dvec3(cases[i].l));
        // Five roundings of products of order one: 3e-7 absolute.
        ASSERT_NEAR(results[i].brdfCosine.y, double(cases[i].albedo.y) * std::max(nl, 0.0), 3e-7);
    }
}

} // namespace
} // namespace tessera
