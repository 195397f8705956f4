// The terms of microfacet models compared with closed forms and published tables (shading.md, section 6).
#include "validation/reference/Microfacet.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

namespace tessera::reference {
namespace {

using std::numbers::pi;

/// Integral over a = 0 .. b by the midpoint rule, whose error falls with the square of the steps.
double integral(double b, int steps, const std::function<double(double)>& f) {
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) sum += f((i + 0.5) * b / steps);
    return sum * b / steps;
}

/// Integral over the hemisphere of half vectors, warped like GGX so that its peak is resolved at any alpha:
/// tan(theta) = alpha tan(t). `f` takes the polar angle and includes the integral over the azimuth.
double overPolarAngles(double alpha, int steps, const std::function<double(double)>& f) {
    return integral(pi / 2.0, steps, [&](double t) {
        const double theta = std::atan(alpha * std::tan(t));
        const double stretch = alpha / (std::pow(std::cos(t), 2) + std::pow(alpha * std::sin(t), 2));
        return f(theta) * std::sin(theta) * stretch;
    });
}

TEST(ReferenceMicrofacet, theDistributionIntegratesToOne) {
    for (const double alpha : {1e-3, 0.01, 0.1, 0.5, 1.0}) {
        const double whole = 2.0 * pi * overPolarAngles(alpha, 4000, [&](double theta) {
                                 return distributionGgx(alpha, std::cos(theta)) * std::cos(theta);
                             });
        EXPECT_NEAR(whole, 1.0, 1e-6) << alpha; // the rule's error at 4000 steps
    }
}

/// Energy that a lobe with F = 1 reflects for a viewer at the cosine `mu`; `masking` of light and view.
double directionalAlbedo(double alpha, double mu, const std::function<double(double, double)>& masking) {
    const double sine = std::sqrt(1.0 - mu * mu);
    return overPolarAngles(alpha, 1500, [&](double theta) {
        return 2.0 * integral(pi, 400, [&](double phi) {
                   const double nh = std::cos(theta), vh = sine * std::sin(theta) * std::cos(phi) + mu * nh;
                   const double nl = 2.0 * vh * nh - mu;
                   if (vh <= 0.0 || nl <= 0.0) return 0.0;
                   // dl = 4 v.h dh cancels a part of the BRDF's denominator.
                   return distributionGgx(alpha, nh) * masking(nl, mu) * vh / mu;
               });
    });
}

TEST(ReferenceMicrofacet, theWeakWhiteFurnaceIsOne) {
    for (const double alpha : {0.1, 0.5, 1.0}) {
        for (const double mu : {0.1, 0.5, 1.0}) {
            const double sine = std::sqrt(1.0 - mu * mu);
            const double whole = overPolarAngles(alpha, 1500, [&](double theta) {
                return 2.0 * integral(pi, 400, [&](double phi) {
                           const double vh = sine * std::sin(theta) * std::cos(phi) + mu * std::cos(theta);
                           return vh > 0.0 ? distributionGgx(alpha, std::cos(theta)) * maskingSmith(alpha, mu) * vh / mu
                                           : 0.0;
                       });
            });
            EXPECT_NEAR(whole, 1.0, 1e-4) << alpha << ' ' << mu; // the kink at v.h = 0 costs the rule two digits
        }
    }
}

TEST(ReferenceMicrofacet, atAlphaOneEnergyIsExactlyItsClosedForm) {
    for (const double mu : {0.1, 0.25, 0.5, 0.75, 1.0}) {
        const double correlated =
            directionalAlbedo(1.0, mu, [](double l, double v) { return maskingCorrelated(1.0, l, v); });
        const double separable =
            directionalAlbedo(1.0, mu, [](double l, double v) { return maskingSmith(1.0, l) * maskingSmith(1.0, v); });
        EXPECT_NEAR(correlated, 1.0 - mu * std::log(1.0 + 1.0 / mu), 1e-4) << mu;
        EXPECT_NEAR(separable, 2.0 * (1.0 - std::numbers::ln2) / (1.0 + mu), 1e-4) << mu;
    }
}

TEST(ReferenceMicrofacet, correlatedEnergyIsThatOfTheTable) {
    constexpr double kAlpha[] = {0.05, 0.1, 0.25, 0.5, 0.75, 1.0};
    constexpr double kMu[] = {0.1, 0.25, 0.5, 0.75, 1.0};
    constexpr double kEnergy[5][6] = {{.9113, .8834, .8916, .8601, .8107, .7602},
                                      {.9745, .9216, .8401, .7652, .6802, .5976},
                                      {.9927, .9692, .8572, .6982, .5646, .4507},
                                      {.9961, .9831, .8915, .6821, .5014, .3645},
                                      {.9973, .9882, .9158, .6879, .4639, .3069}};
    for (int row = 0; row < 5; ++row) {
        for (int column = 0; column < 6; ++column) {
            const double alpha = kAlpha[column];
            const double energy =
                directionalAlbedo(alpha, kMu[row], [&](double l, double v) { return maskingCorrelated(alpha, l, v); });
            EXPECT_NEAR(energy, kEnergy[row][column], 3e-4) << kMu[row] << ' ' << alpha; // errors of table and rule
        }
    }
}

TEST(ReferenceMicrofacet, fresnelIsTheFormOfCookAndTorranceToo) {
    for (const double ior : {0.6, 0.95, 1.0001, 1.33, 1.5, 2.4, 30.0}) {
        for (double c = 0.01; c <= 1.0; c += 0.01) {
            const double g2 = ior * ior - 1.0 + c * c;
            if (std::abs(g2) < 1e-9) continue; // at the critical angle the root amplifies rounding
            const double g = std::sqrt(std::max(g2, 0.0));
            const double a = (g - c) / (g + c), b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
            const double wanted = g2 < 0.0 ? 1.0 : 0.5 * a * a * (1.0 + b * b);
            // Near ior = 1 the form here loses digits of g - c.
            EXPECT_NEAR(fresnelDielectric(ior, c), wanted, 1e-11) << ior << ' ' << c;
        }
    }
}

TEST(ReferenceMicrofacet, fresnelMeetsItsClosedForms) {
    for (const double ior : {0.7, 1.2, 1.5, 2.0}) {
        const double normal = (ior - 1.0) / (ior + 1.0);
        EXPECT_NEAR(fresnelDielectric(ior, 1.0), normal * normal, 1e-15) << ior;
        // Brewster's angle, tan = ior: the parallel polarisation vanishes; the other is ((ior^2-1)/(ior^2+1))^2.
        const double share = (ior * ior - 1.0) / (ior * ior + 1.0);
        EXPECT_NEAR(fresnelDielectric(ior, 1.0 / std::sqrt(1.0 + ior * ior)), 0.5 * share * share, 1e-15) << ior;
        EXPECT_NEAR(fresnelDielectric(ior, 0.0), 1.0, 1e-15) << ior;
    }
    EXPECT_EQ(fresnelDielectric(0.6, 0.79), 1.0); // critical angle: cos = sqrt(1 - 0.36) = 0.8
    EXPECT_LT(fresnelDielectric(0.6, 0.81), 1.0);
    for (const double c : {0.0, 0.3, 1.0}) EXPECT_EQ(fresnelDielectric(1.0, c), 0.0);
}

TEST(ReferenceMicrofacet, schlickMeetsItsEndPointsAndOneBetween) {
    EXPECT_EQ(fresnelSchlick(0.04, 0.9, 1.0), 0.04);
    EXPECT_EQ(fresnelSchlick(0.04, 0.9, 0.0), 0.9);
    EXPECT_DOUBLE_EQ(fresnelSchlick(0.04, 1.0, 0.5), 0.04 + 0.96 / 32.0);
}

/// Both sums of the split-sum approximation, glTF's model: A weighs F0, B is what Schlick adds.
TEST(ReferenceMicrofacet, splitSumsAreThoseOfTheTable) {
    struct Row {
        double mu, roughness, a, b;
    };
    for (const Row& row : {Row{0.1, 0.25, .5051, .3916}, Row{0.1, 0.5, .7519, .1397}, Row{0.1, 0.75, .7958, .0526},
                           Row{0.1, 1.0, .7363, .0239}, Row{0.5, 0.25, .9557, .0326}, Row{0.5, 0.5, .8349, .0223},
                           Row{0.5, 0.75, .6547, .0085}, Row{0.5, 1.0, .4477, .0030}, Row{1.0, 0.25, .9957, .0000},
                           Row{1.0, 0.5, .9158, .0000}, Row{1.0, 0.75, .6268, .0000}, Row{1.0, 1.0, .3067, .0000}}) {
        const double alpha = row.roughness * row.roughness, sine = std::sqrt(1.0 - row.mu * row.mu);
        double a = 0.0, b = 0.0;
        const auto sum = [&](double f0, double f90) {
            return overPolarAngles(alpha, 1500, [&](double theta) {
                return 2.0 * integral(pi, 400, [&](double phi) {
                           const double nh = std::cos(theta);
                           const double vh = sine * std::sin(theta) * std::cos(phi) + row.mu * nh;
                           const double nl = 2.0 * vh * nh - row.mu;
                           if (vh <= 0.0 || nl <= 0.0) return 0.0;
                           return fresnelSchlick(f0, f90, vh) * distributionGgx(alpha, nh) *
                                  maskingCorrelated(alpha, nl, row.mu) * vh / row.mu;
                       });
            });
        };
        a = sum(1.0, 0.0);
        b = sum(0.0, 1.0);
        EXPECT_NEAR(a, row.a, 3e-4) << row.mu << ' ' << row.roughness; // last digits of the table, and the rule's error
        EXPECT_NEAR(b, row.b, 3e-4) << row.mu << ' ' << row.roughness;
    }
}

} // namespace
} // namespace tessera::reference
