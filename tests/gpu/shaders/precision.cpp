// Accuracy of the microfacet terms, compared with double precision at the same fp32 arguments.
#include <algorithm>

#include <gtest/gtest.h>

#include "shaders/shared/facet.h"
#include "tests/gpu/shaders/ShaderBench.h"
#include "tests/support/Random.h"

namespace tessera {
namespace {

using test::pi;

struct FresnelCase {
    float ior, cosine;
};

/// The unpolarised dielectric reflectance as the mean of its s and p parts. Source: Born and Wolf, "Principles of
/// Optics", 1.5.2.
double fresnelOfPolarisations(double ior, double c) {
    const double eta = 1.0 / ior; // n1 / n2
    const double beta2 = 1.0 / (eta * eta) + c * c - 1.0;
    if (beta2 < 0.0) return 1.0;
    const double beta = std::sqrt(beta2);
    const double s = (c - beta) / (c + beta);
    const double p = (eta * eta * beta - c) / (eta * eta * beta + c);
    return 0.5 * (s * s + p * p);
}

class PrecisionTest : public test::GlTest {
protected:
    /// Largest relative error of D at `alpha` over half vectors in and around the lobe of random normals.
    double distributionError(float alpha, int count) {
        test::Random random(1);
        std::vector<glm::vec4> inputs;
        std::vector<double> expected;
        while (int(expected.size()) < count) {
            const glm::vec3 n(random.direction());
            const double theta = std::atan(alpha * std::tan(0.49 * pi * random.unit())); // most of them within the lobe
            const glm::vec3 h(random.around(glm::normalize(glm::dvec3(n)), std::cos(theta), std::cos(theta)));
            const glm::dvec3 across = glm::cross(glm::dvec3(n), glm::dvec3(h));
            const double c = glm::dot(glm::dvec3(n), glm::dvec3(h)), a2 = double(alpha) * double(alpha);
            if (!(c > 0.01)) continue;
            const double t = a2 * c * c + glm::dot(across, across);
            expected.push_back(a2 / (pi * t * t));
            inputs.insert(inputs.end(), {{n, alpha}, {h, 1}, {1, 1, 1, 0}});
        }
        const std::vector<glm::vec4> out = bench.run("stress/terms.comp", {}, inputs, expected.size(), 2);
        double worst = 0.0;
        for (std::size_t i = 0; i < expected.size(); ++i)
            worst = std::max(worst, std::abs(double(out[2 * i].x) / expected[i] - 1.0));
        return worst;
    }

    std::vector<double> fresnel(const std::vector<FresnelCase>& cases) {
        std::vector<glm::vec4> inputs;
        for (const FresnelCase& c : cases)
            inputs.insert(inputs.end(), {{0, 0, 1, 1}, {0, 0, 1, 1}, {1, c.ior, c.cosine, 0}});
        const std::vector<glm::vec4> out = bench.run("stress/terms.comp", {}, inputs, cases.size(), 2);
        std::vector<double> f;
        for (std::size_t i = 0; i < cases.size(); ++i) f.push_back(double(out[2 * i].w));
        return f;
    }
    test::ShaderBench bench;
};

TEST_F(PrecisionTest, theDistributionKeepsItsDigitsAtSmallAlpha) {
    // shading.md: the cross product keeps the digits that 1 - (n.h)^2 loses. n x h cancels to about alpha, so its
    // relative error in fp32 is 6e-8 / alpha.
    EXPECT_LE(distributionError(0.002f, 200000), 1e-4);
    EXPECT_LE(distributionError(0.01f, 200000), 2e-5);
    EXPECT_LE(distributionError(0.3f, 200000), 2e-6);
}

// The half vector lies in the lobe, so that light and viewer graze the surface on opposite sides.
TEST_F(PrecisionTest, theDistributionKeepsItsDigitsWhereLightAndViewerAreNearlyOpposite) {
    // The sum of l and v is exact in fp32 or nearly so; its part across n cancels like n x h in the test above.
    struct Bar {
        double alpha, error;
    };
    for (const Bar& bar : {Bar{0.002, 2e-4}, Bar{0.01, 4e-5}, Bar{0.1, 4e-6}, Bar{0.3, 2e-6}}) {
        test::Random random(3);
        std::vector<glm::vec4> inputs;
        std::vector<double> expected;
        while (expected.size() < 100000) {
            const glm::vec3 n(glm::normalize(random.direction()));
            const double theta = std::atan(bar.alpha * std::tan(0.49 * pi * random.unit()));
            const glm::dvec3 h = random.around(glm::normalize(glm::dvec3(n)), std::cos(theta), std::cos(theta));
            const glm::dvec3 beside = glm::normalize(glm::cross(h, random.direction()));
            const double half = random.logarithmic(1e-4, 1e-2); // half of the angle missing to opposite
            const glm::vec3 l(std::sin(half) * h + std::cos(half) * beside);
            const glm::vec3 v(std::sin(half) * h - std::cos(half) * beside);
            const glm::dvec3 sum = glm::dvec3(l) + glm::dvec3(v), across = glm::cross(glm::dvec3(n), sum);
            const double along = glm::dot(glm::dvec3(n), sum), a2 = bar.alpha * bar.alpha;
            if (!(along > 0.01 * glm::length(sum))) continue;
            const double t = (a2 * along * along + glm::dot(across, across)) / glm::dot(sum, sum);
            expected.push_back(a2 / (pi * t * t));
            inputs.insert(inputs.end(), {{n, float(bar.alpha)}, {l, 0}, {v, 0}});
        }
        const std::vector<glm::vec4> out = bench.run("test/half_sum.comp", {}, inputs, expected.size(), 1);
        double worst = 0.0;
        for (std::size_t i = 0; i < expected.size(); ++i)
            worst = std::max(worst, std::abs(double(out[i].x) / expected[i] - 1.0));
        EXPECT_LE(worst, bar.error) << bar.alpha;
    }
}

TEST_F(PrecisionTest, fresnelEqualsTheMeanOfItsPolarisations) {
    test::Random random(2);
    std::vector<FresnelCase> cases;
    for (int i = 0; i < 200000; ++i)
        cases.push_back({float(random.logarithmic(1.0001, 1000.0)), float(random.between(1e-4, 1.0))});
    for (const float away : {1e-6f, 2e-6f, 1e-5f, 1e-4f})
        for (int i = 1; i <= 200; ++i)
            for (const float sign : {-1.0f, 1.0f})
                cases.push_back({1.0f + sign * away, 0.5f + 0.5f * float(i) / 200.0f});
    const std::vector<double> f = fresnel(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double expected = fresnelOfPolarisations(cases[i].ior, cases[i].cosine);
        // About ten roundings of 6e-8, some squared, stay below 1e-5 when nothing cancels.
        ASSERT_NEAR(f[i], expected, 1e-5 * expected) << "ior " << cases[i].ior << " cosine " << cases[i].cosine;
    }
}

/// The form of Cook and Torrance 1982, as printed in textbooks.
double fresnelOfCookTorrance(double ior, double c) {
    const double g2 = ior * ior - 1.0 + c * c;
    if (g2 < 0.0) return 1.0;
    const double g = std::sqrt(g2), a = (g - c) / (g + c), b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

TEST_F(PrecisionTest, bothFormsOfFresnelAgree) {
    test::Random random(9);
    std::vector<FresnelCase> cases;
    for (int i = 0; i < 100000; ++i)
        cases.push_back({float(random.logarithmic(0.2, 1000.0)), float(random.between(1e-3, 1.0))});
    const std::vector<double> f = fresnel(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double ior = double(cases[i].ior), c = double(cases[i].cosine);
        const double polarised = fresnelOfPolarisations(ior, c);
        ASSERT_NEAR(fresnelOfCookTorrance(ior, c), polarised, 1e-11) << "ior " << ior << " cosine " << c;
        ASSERT_NEAR(f[i], polarised, 1e-6) << "ior " << ior << " cosine " << c;
    }
}

TEST_F(PrecisionTest, fresnelBelowOneIsRightUpToItsCriticalAngle) {
    test::Random random(3);
    std::vector<FresnelCase> cases;
    std::vector<double> g2;
    while (cases.size() < 100000) {
        const float ior = float(random.between(0.2, 0.999));
        const double critical = std::sqrt(1.0 - double(ior) * double(ior));
        const bool near = cases.size() % 2 == 0;
        const float cosine = float(near ? critical + random.between(-5e-5, 5e-5) : random.between(1e-4, 1.0));
        if (!(cosine > 0.0f && cosine <= 1.0f)) continue;
        cases.push_back({ior, cosine});
        g2.push_back(double(ior) * double(ior) - 1.0 + double(cosine) * double(cosine));
    }
    const std::vector<double> f = fresnel(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double expected = fresnelOfPolarisations(cases[i].ior, cases[i].cosine);
        // As above one: accurate at the critical angle too, where F falls from 1 like 1 - k sqrt(g2), because g2 keeps
        // its digits.
        ASSERT_NEAR(f[i], expected, 1e-5) << "ior " << cases[i].ior << " cosine " << cases[i].cosine;
        ASSERT_LE(f[i], 1.0 + 1e-6);
        if (g2[i] < 0.0) {
            ASSERT_EQ(f[i], 1.0) << "total internal reflection at ior " << cases[i].ior;
        }
    }
}

TEST_F(PrecisionTest, fresnelOfEqualMediaIsExactlyZero) {
    std::vector<FresnelCase> cases;
    for (int i = -100; i <= 100; ++i) cases.push_back({1.0f, float(i) / 100.0f});
    for (const double f : fresnel(cases)) EXPECT_EQ(f, 0.0);
}

TEST_F(PrecisionTest, schlickMeetsItsEndPointsExactly) {
    std::vector<glm::vec4> inputs;
    const std::vector<float> f0s{0.0f, 0.04f, 0.5f, 1.0f};
    for (const float f0 : f0s)
        for (const float cosine : {1.0f, 0.0f})
            inputs.insert(inputs.end(), {{0, 0, 1, 1}, {0, 0, 1, 1}, {1, 1, cosine, f0}});
    const std::vector<glm::vec4> out = bench.run("stress/terms.comp", {}, inputs, f0s.size() * 2, 2);
    for (std::size_t i = 0; i < f0s.size(); ++i) {
        EXPECT_EQ(out[4 * i + 1].x, f0s[i]);
        EXPECT_NEAR(out[4 * i + 3].x, 1.0f, 6e-8f) << "f0 + (1 - f0) rounds twice";
    }
}

TEST_F(PrecisionTest, aVectorOfAnyLengthIsNormalisedAndOnlyThatOfNoLengthIsNot) {
    std::vector<glm::vec4> inputs;
    const std::vector<float> lengths{1e-37f, 1e-25f, 1e-10f, 1.0f, 1e10f, 1e25f, 1e37f, 0.0f};
    for (const float length : lengths)
        inputs.insert(inputs.end(), {{2.0f * length, -3.0f * length, 6.0f * length, 0}, {0, 0, 1, 0}});
    const std::vector<glm::vec4> out = bench.run("test/vectors.comp", {}, inputs, lengths.size(), 2);
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        SCOPED_TRACE(lengths[i]);
        const glm::dvec3 wanted = lengths[i] > 0.0f ? glm::dvec3(2, -3, 6) / 7.0 : glm::dvec3(7.0);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(out[2 * i][c], wanted[c], 3e-7); // five roundings
    }
}

TEST_F(PrecisionTest, aNormalKeepsItsDirectionAtAnyLength) {
    test::Random random(6);
    std::vector<glm::vec4> inputs;
    for (int i = 0; i < 200000; ++i)
        inputs.emplace_back(glm::vec3(random.direction() * random.logarithmic(1e-30, 1e30)), 0.0f);
    const std::vector<glm::vec4> out = bench.run("test/normals.comp", {}, inputs, inputs.size(), 1);
    double sum = 0.0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const glm::dvec3 wanted = glm::normalize(glm::dvec3(inputs[i]));
        const double error = glm::distance(glm::dvec3(out[i]), wanted);
        // Half a step of 2^-24 in two ratios of components, and five roundings.
        ASSERT_LE(error, 2e-7) << wanted.x << " " << wanted.y << " " << wanted.z;
        sum += error;
    }
    EXPECT_LE(sum / double(inputs.size()), 5e-8);
}

TEST_F(PrecisionTest, normalsAlongAnAxisAreExactAndThoseOfNoLengthPointUp) {
    std::vector<glm::vec4> inputs{glm::vec4(0.0f)}, wanted{{0, 0, 1, 0}};
    for (int axis = 0; axis < 3; ++axis)
        for (const float length : {1e-30f, -1e-30f, 0.3f, -0.3f, 1.0f, -1.0f, 1e30f, -1e30f}) {
            inputs.emplace_back(0.0f)[axis] = length;
            wanted.emplace_back(0.0f)[axis] = length > 0.0f ? 1.0f : -1.0f;
        }
    const std::vector<glm::vec4> out = bench.run("test/normals.comp", {}, inputs, inputs.size(), 1);
    // Division by the length, which is 1: exact with Mesa; GLSL 4.50 (section 4.7.1) allows errors of some ulp in a
    // root and a division.
    const double allowed = context().capabilities().isSoftware ? 0.0 : 2.5e-7;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(out[i][c], wanted[i][c], allowed) << inputs[i].x << " " << c;
}

/// The direction of a position on the octahedral square -1..1, and the position of a direction of any length.
glm::dvec3 octahedral(const glm::dvec2& place) {
    const double z = 1.0 - std::abs(place.x) - std::abs(place.y);
    if (z >= 0.0) return glm::normalize(glm::dvec3(place, z));
    return glm::normalize(glm::dvec3(std::copysign(1.0 - std::abs(place.y), place.x),
                                     std::copysign(1.0 - std::abs(place.x), place.y), z));
}
glm::dvec2 octahedralPlace(const glm::dvec3& direction) {
    const glm::dvec3 n = direction / (std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z));
    if (n.z >= 0.0) return glm::dvec2(n);
    return {std::copysign(1.0 - std::abs(n.y), n.x), std::copysign(1.0 - std::abs(n.x), n.y)};
}

TEST_F(PrecisionTest, normalsOfTrianglesAreStoredAsTheNearestPlaceOfTheirGrid) {
    constexpr double kSteps = (1 << FACET_BITS) - 2;
    test::Random random(8);
    std::vector<glm::vec4> inputs;
    for (int i = 0; i < 20000; ++i) inputs.push_back({glm::vec3(random.direction()), 0});
    const std::vector<glm::vec4> out = bench.run("test/facets.comp", {}, inputs, inputs.size(), 1);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const glm::dvec2 steps = (0.5 * octahedralPlace(glm::dvec3(inputs[i])) + 0.5) * kSteps;
        const glm::dvec2 nearest = glm::floor(steps + 0.5), away = glm::abs(steps - nearest);
        // Roundings of 1e-7 of all steps may select either of two neighbours.
        if (std::max(away.x, away.y) > 0.499) continue;
        ASSERT_LT(glm::distance(glm::dvec3(out[i]), octahedral(2.0 * nearest / kSteps - 1.0)), 1e-6) << i;
    }
}

TEST_F(PrecisionTest, normalsOfTrianglesAreStoredWithinTheirBound) {
    test::Random random(6);
    std::vector<glm::vec4> inputs;
    for (int i = 0; i < 200000; ++i) inputs.push_back({glm::vec3(random.direction()), 0});
    const std::vector<glm::vec4> out = bench.run("test/facets.comp", {}, inputs, inputs.size(), 1);
    double worst = 0.0;
    for (std::size_t i = 0; i < inputs.size(); ++i)
        worst = std::max(worst, glm::distance(glm::dvec3(out[i]), glm::normalize(glm::dvec3(inputs[i]))));
    EXPECT_LE(worst, FACET_ERROR_RADIANS);
    EXPECT_GE(worst, 0.5 * FACET_ERROR_RADIANS) << "the bound is not tight";
}

/// pow() alone has a larger error.
TEST_F(PrecisionTest, srgbIsDecodedToAFewRoundings) {
    // Ten roundings of 2^-24: of 1.055, the sum and the quotient, each times 2.4 by the power, and of three products.
    constexpr double kTenRoundings = 6e-7;
    std::vector<glm::vec4> inputs;
    for (int i = 0; i <= 4096; ++i) inputs.emplace_back(float(i) / 4096.0f);
    const std::vector<glm::vec4> out =
        bench.run("test/decode_srgb.comp", {{"FILTER_EXACT", "1"}}, inputs, inputs.size(), 1);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const double code = double(inputs[i].x);
        const double wanted = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
        ASSERT_NEAR(out[i].x, wanted, kTenRoundings * wanted) << code;
    }
}

// The substitute tangent of surfaces without tangents.
TEST_F(PrecisionTest, anyPerpendicularIsUnitAndAtRightAngles) {
    test::Random random(5);
    std::vector<glm::vec4> inputs;
    constexpr std::size_t kCount = 20000;
    for (std::size_t i = 0; i < kCount; ++i)
        inputs.insert(inputs.end(), {glm::vec4(1), {glm::vec3(random.direction()), 0}});
    for (const float z : {-1.0f, 1.0f}) inputs.insert(inputs.end(), {glm::vec4(1), {0, 0, z, 0}});
    const std::vector<glm::vec4> out = bench.run("test/vectors.comp", {}, inputs, kCount + 2, 2);
    for (std::size_t i = 0; i < kCount + 2; ++i) {
        const glm::dvec3 n(inputs[2 * i + 1]), found(out[2 * i + 1]);
        // Products and sums of numbers up to 1; some six roundings.
        ASSERT_NEAR(glm::length(found), 1.0, 4e-7) << "n.z " << n.z;
        ASSERT_NEAR(glm::dot(found, n), 0.0, 4e-7) << "n.z " << n.z;
    }
}

} // namespace
} // namespace tessera
