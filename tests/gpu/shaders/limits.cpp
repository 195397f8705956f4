// What reflectedShare and specularTerms do at the edges of their domain, and over many random surfaces.
#include <gtest/gtest.h>

#include "shaders/shared/models.h"
#include "tests/gpu/shaders/ShaderBench.h"
#include "tests/support/Random.h"

namespace tessera {
namespace {

const shader::Defines kModels{{"HAS_METALLIC_ROUGHNESS", "1"}, {"HAS_MICROFACET", "1"}, {"HAS_LIT_MODELS", "1"}};

struct Case {
    unsigned model = MODEL_LAMBERT;
    glm::vec3 albedo{0.5f};
    float metallic = 0.0f;
    glm::vec3 n{0, 0, 1};
    float alpha = 0.5f;
    glm::vec3 specular{1.0f};
    float iorOrF90 = 1.0f;
    glm::vec3 l{0, 0, 1};
    glm::vec3 v{0, 0, 1};
    float intensity = 1.0f;
};

struct Result {
    glm::vec3 share;
    float nl;
    float d, v, f;
    glm::vec3 lit; ///< share x intensity
};

class LimitsTest : public test::GlTest {
protected:
    std::vector<Result> run(const std::vector<Case>& cases) {
        std::vector<glm::vec4> inputs;
        inputs.reserve(cases.size() * 5);
        for (const Case& c : cases) {
            inputs.insert(inputs.end(), {{c.albedo, c.metallic},
                                         {c.n, c.alpha},
                                         {c.specular, c.iorOrF90},
                                         {c.l, float(c.model)},
                                         {c.v, c.intensity}});
        }
        const std::vector<glm::vec4> out = bench.run("reflect.comp", kModels, inputs, cases.size(), 3);
        std::vector<Result> results;
        results.reserve(cases.size());
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const glm::vec4 &a = out[3 * i], &b = out[3 * i + 1];
            results.push_back({glm::vec3(a), a.w, b.x, b.y, b.z, glm::vec3(out[3 * i + 2])});
        }
        return results;
    }
    test::ShaderBench bench;
};

bool isFiniteAndPositive(const glm::vec3& c) {
    return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z) && c.x >= 0.0f && c.y >= 0.0f && c.z >= 0.0f;
}

Case randomCase(test::Random& random, unsigned model) {
    Case c;
    c.model = model;
    c.albedo = {random.unit(), random.unit(), random.unit()};
    c.metallic = float(random.index(3) == 0 ? random.index(2) : random.unit());
    c.n = glm::vec3(random.direction());
    c.alpha = random.index(4) == 0 ? float(ALPHA_MIN) : float(random.logarithmic(ALPHA_MIN, 1.0));
    c.specular = {random.unit(), random.unit(), random.unit()};
    c.iorOrF90 = float(model == MODEL_MICROFACET ? random.logarithmic(0.2, 1000.0) : random.unit());
    const glm::dvec3 n = glm::normalize(glm::dvec3(c.n));
    c.l = glm::vec3(random.around(n, -1.0, 1.0));
    c.v = glm::vec3(random.around(n, -1.0, 1.0));
    switch (random.index(8)) {
    case 0:
        c.v = -c.l;
        break;
    case 1:
        c.v = c.l;
        break;
    case 2:
        c.v = glm::vec3(glm::reflect(-glm::dvec3(c.l), n));
        break; // the peak
    case 3:
        c.l = glm::vec3(random.around(n, -1e-6, 1e-6));
        break; // grazing light
    case 4:
        c.v = glm::vec3(random.around(n, -1e-6, 1e-6));
        break; // grazing view
    default:
        break;
    }
    c.intensity = float(random.logarithmic(1e-20, 1e20));
    return c;
}

TEST_F(LimitsTest, aRandomSurfaceIsNeverNaNInfiniteOrNegative) {
    constexpr int kBatch = 1 << 18;
    test::Random random(4);
    for (const unsigned model : {MODEL_LAMBERT, MODEL_MICROFACET, MODEL_METALLIC_ROUGHNESS}) {
        for (int batch = 0; batch < 4; ++batch) {
            std::vector<Case> cases;
            cases.reserve(kBatch);
            for (int i = 0; i < kBatch; ++i) cases.push_back(randomCase(random, model));
            const std::vector<Result> results = run(cases);
            int lit = 0;
            for (std::size_t i = 0; i < results.size(); ++i) {
                const Result& r = results[i];
                ASSERT_TRUE(isFiniteAndPositive(r.share) && isFiniteAndPositive(r.lit))
                    << "model " << model << " sample " << i;
                ASSERT_TRUE(isFiniteAndPositive({r.d, r.v, r.f})) << "model " << model << " sample " << i;
                lit += r.share.x > 0.0f;
            }
            EXPECT_GT(lit, kBatch / 4); // light comes from above for nearly half of them
        }
    }
}

TEST_F(LimitsTest, specularAloneIsAlwaysReciprocal) {
    test::Random random(5);
    std::vector<Case> cases;
    for (int i = 0; i < 200000; ++i) {
        Case c = randomCase(random, i % 2 == 0 ? MODEL_MICROFACET : MODEL_METALLIC_ROUGHNESS);
        c.iorOrF90 = i % 2 == 0 ? float(random.between(1.1, 3.0)) : 1.0f;
        c.alpha = float(random.logarithmic(0.01, 1.0));
        // Above 0.05, so |l + v| >= 0.1 and h keeps its digits; below, l.h and v.h differ by the rounding of h alone.
        const glm::dvec3 n = glm::normalize(glm::dvec3(c.n));
        c.l = glm::vec3(random.around(n, 0.05, 1.0));
        c.v = glm::vec3(random.around(n, 0.05, 1.0));
        cases.push_back(c);
        std::swap(c.l, c.v);
        cases.push_back(c);
    }
    const std::vector<Result> results = run(cases);
    for (std::size_t i = 0; i < cases.size(); i += 2) {
        const double there = double(results[i].d) * results[i].v * results[i].f;
        const double back = double(results[i + 1].d) * results[i + 1].v * results[i + 1].f;
        ASSERT_GT(there, 0.0);
        ASSERT_NEAR(there, back, 1e-5 * there) << "sample " << i;
    }
}

TEST_F(LimitsTest, aBlackMicrofacetSurfaceAlwaysReflectsExactlyItsSpecularTerms) {
    test::Random random(6);
    std::vector<Case> cases;
    for (int i = 0; i < 20000; ++i) {
        cases.push_back(randomCase(random, MODEL_MICROFACET));
        cases.back().albedo = glm::vec3(0.0f);
        cases.back().specular = glm::vec3(1.0f);
    }
    const std::vector<Result> results = run(cases);
    for (const Result& r : results) {
        const float expected = r.nl > 0.0f ? r.f * (r.d * r.v) * r.nl : 0.0f;
        ASSERT_EQ(r.share.x, expected);
    }
}

TEST_F(LimitsTest, specularIsExactlyZeroWhereItsDirectionsHaveNoLobe) {
    const glm::vec3 up(0, 0, 1), side(1, 0, 0), slant(0.6f, 0.0f, 0.8f), below(0.6f, 0.0f, -0.8f);
    for (const unsigned model : {MODEL_MICROFACET, MODEL_METALLIC_ROUGHNESS}) {
        for (const float alpha : {float(ALPHA_MIN), 0.1f, 1.0f}) {
            std::vector<Case> cases;
            for (const auto& [l, v] :
                 {std::pair(side, up), std::pair(up, side), std::pair(side, side), std::pair(slant, -slant),
                  std::pair(below, up), std::pair(slant, below), std::pair(side, -side), std::pair(up, -up)}) {
                Case c;
                c.model = model;
                c.alpha = alpha;
                c.iorOrF90 = model == MODEL_MICROFACET ? 1.5f : 1.0f;
                c.specular = glm::vec3(model == MODEL_MICROFACET ? 1.0f : 0.04f);
                c.l = l;
                c.v = v;
                cases.push_back(c);
            }
            const std::vector<Result> results = run(cases);
            for (std::size_t i = 0; i < results.size(); ++i) {
                EXPECT_EQ(results[i].d * results[i].v, 0.0f)
                    << "model " << model << " alpha " << alpha << " case " << i;
                EXPECT_TRUE(isFiniteAndPositive(results[i].share))
                    << "model " << model << " alpha " << alpha << " case " << i;
                if (!(results[i].nl > 0.0f)) {
                    EXPECT_EQ(results[i].share, glm::vec3(0.0f));
                }
            }
            // Diffuse needs only n.l > 0: straight light seen from the horizon.
            EXPECT_GT(results[1].share.x, 0.0f);
        }
    }
}

TEST_F(LimitsTest, lambertIsAlwaysItsColourTimesTheCosine) {
    test::Random random(7);
    std::vector<Case> cases;
    for (int i = 0; i < 20000; ++i) cases.push_back(randomCase(random, MODEL_LAMBERT));
    const std::vector<Result> results = run(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double nl = glm::dot(glm::dvec3(cases[i].n), glm::dvec3(cases[i].l));
        // Five roundings of products of order one: 3e-7 absolute.
        ASSERT_NEAR(results[i].share.y, double(cases[i].albedo.y) * std::max(nl, 0.0), 3e-7);
    }
}

} // namespace
} // namespace tessera
