#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/frame/LobeTable.h"
#include "shaders/shared/lobe_table.h"
#include "tests/image/Textbook.h"
#include "tests/support/Sweep.h"
#include "validation/reference/Lobes.h"

namespace tessera::frame {
namespace {

using std::numbers::pi;

/// Made once for all tests.
const std::vector<glm::vec4>& lobeTable() {
    static const std::vector<glm::vec4> table = makeLobeTable();
    return table;
}

/// Interpolates a layer as shaders do, at coordinates from 0 to 1.
glm::vec4 interpolatedAt(const std::vector<glm::vec4>& table, const glm::dvec2& along, int layer) {
    const glm::dvec2 place = along * (LOBE_TABLE_SIDE - 1.0);
    const glm::ivec2 low = glm::min(glm::ivec2(place), glm::ivec2(LOBE_TABLE_SIDE - 2));
    const glm::vec2 share(place - glm::dvec2(low));
    const auto texel = [&](int i, int j) {
        return table[std::size_t((layer * LOBE_TABLE_SIDE + low.y + j) * LOBE_TABLE_SIDE + low.x + i)];
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), share.x), glm::mix(texel(0, 1), texel(1, 1), share.x), share.y);
}

glm::vec4 lookedUp(const std::vector<glm::vec4>& table, double cosine, double alpha) {
    return interpolatedAt(table, glm::sqrt(glm::dvec2(cosine, alpha)), LOBE_LAYER_GGX);
}

/// Unpolarised Fresnel reflectance by Snell's law.
double fresnelBySnell(double ior, double cosine) {
    const double sine = std::sqrt(1.0 - cosine * cosine) / ior;
    if (!(sine < 1.0)) return 1.0;
    const double inside = std::sqrt(1.0 - sine * sine);
    const double across = (cosine - ior * inside) / (cosine + ior * inside);
    const double along = (ior * cosine - inside) / (ior * cosine + inside);
    return 0.5 * (across * across + along * along);
}

/// reflectedByDielectric() of shaders/lib/reflectance/even_light.glsl.
double dielectricLookedUp(const std::vector<glm::vec4>& table, double ior, double cosine, double alpha) {
    const double number = double(shared::iorPlace(float(ior)));
    const bool isDenser = ior >= 1.0;
    const int first = std::min(int(number), (isDenser ? LOBE_TABLE_IORS - 1 : LOBE_TABLE_IOR_ONE) - 2);
    const double t = number - first;
    const double shares[] = {0.5 * (t - 1.0) * (t - 2.0), t * (2.0 - t), 0.5 * t * (t - 1.0)};
    const glm::dvec2 place(double(shared::lobeColumn(float(ior), float(cosine))), std::sqrt(alpha));
    double reflected = 0.0;
    for (int i = 0; i < 3; ++i) {
        if (!isDenser && first + i == LOBE_TABLE_IOR_ONE) continue;
        reflected +=
            shares[i] * double(interpolatedAt(table, place, LOBE_LAYER_DIELECTRIC + (first + i) / 4)[(first + i) % 4]);
    }
    if (isDenser) {
        const double root = double(interpolatedAt(table, place, LOBE_LAYER_SHEEN).z);
        reflected *= fresnelBySnell(ior, root * root);
    }
    return std::clamp(reflected, 0.0, 1.0);
}

/// Reflectance by half vectors h of density D n.h, dl = 4 v.h dh: the mean of F G v.h / (n.v n.h).
double reflectedByHalfVectors(double ior, double cosView, double alpha) {
    constexpr int kRings = 512, kTurns = 256;
    const double sine = std::sqrt(1.0 - cosView * cosView);
    const auto masked = [&](double cosine) {
        return 2.0 * cosine / (cosine + std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine));
    };
    double sum = 0.0;
    for (int i = 0; i < kRings; ++i) {
        const double left = (i + 0.5) / kRings, weight = 4.0 * left * left * left; // finer far from the normal
        const double u = 1.0 - left * left * left * left, slope = alpha * std::sqrt(u / (1.0 - u));
        const double cosHalf = 1.0 / std::sqrt(1.0 + slope * slope), sineHalf = slope * cosHalf;
        for (int j = 0; j < kTurns; ++j) {
            const double turn = 2.0 * pi * (j + std::fmod(0.618 * i, 1.0)) / kTurns;
            const double incidence = cosHalf * cosView + sineHalf * sine * std::cos(turn);
            const double cosLight = 2.0 * incidence * cosHalf - cosView;
            if (!(incidence > 0.0 && cosLight > 0.0)) continue;
            sum += weight * fresnelBySnell(ior, std::min(incidence, 1.0)) * masked(cosLight) * masked(cosView) *
                   incidence / (cosView * cosHalf);
        }
    }
    return sum / (double(kRings) * kTurns);
}

/// Indices on both sides of 1, including the onset of total reflection; a reduced sweep takes every third of them.
void expectDielectricsLobe() {
    const std::vector<glm::vec4>& table = lobeTable();
    for (const double ior :
         ::tessera::test::everyNth(std::vector{0.15, 0.4, 0.6, 0.7, 0.75, 0.83, 0.93, 0.98, 1.2, 1.33, 1.5, 2.5}, 3))
        for (const double alpha : {0.005, 0.03, 0.1, 0.3, 0.6, 1.0})
            for (int i = 0; i < 12; ++i) {
                const double cosine = 0.08 + 0.083 * i;
                const double truth = reflectedByHalfVectors(ior, cosine, alpha);
                EXPECT_NEAR(dielectricLookedUp(table, ior, cosine, alpha), truth, 0.02 * truth + 5e-4)
                    << ior << ", alpha " << alpha << ", cosine " << cosine;
            }
}
TEST(LobeTable, aDielectricsLobeIsInterpolatedWithinTwoPercent) {
    expectDielectricsLobe();
}
TEST(LobeTableSlow, aDielectricsLobeIsInterpolatedWithinTwoPercent) {
    expectDielectricsLobe();
}

/// Indices halfway between the table's from 1 to 3, where an earlier table of reflectances had a relative error of 1,
/// and ends of that range; a reduced sweep takes every third. No absolute tolerance from a viewer's cosine of 0.08 up.
void expectIndicesFrom1To3() {
    const std::vector<glm::vec4>& table = lobeTable();
    std::vector<double> iors{1.02, 1.1, 3.0};
    constexpr double kAbove = LOBE_TABLE_IORS - 1 - LOBE_TABLE_IOR_ONE;
    for (double place = 0.5; place < 0.75 * kAbove; place += 1.0) {
        const double contrast = std::pow(place / kAbove, 3.0), ior = (1.0 + contrast) / (1.0 - contrast);
        EXPECT_NEAR(double(shared::iorPlace(float(ior))), LOBE_TABLE_IOR_ONE + place, 0.02);
        iors.push_back(ior);
    }
    for (const double ior : ::tessera::test::everyNth(iors, 3))
        for (const double alpha : {0.001, 0.03, 0.1, 0.3, 1.0})
            for (const double cosine : {0.01, 0.03, 0.08, 0.25, 0.6, 0.993}) {
                const double truth = reflectedByHalfVectors(double(float(ior)), cosine, alpha);
                EXPECT_NEAR(dielectricLookedUp(table, double(float(ior)), cosine, alpha), truth,
                            0.02 * truth + (cosine < 0.08 ? 2e-3 : 0.0))
                    << ior << ", alpha " << alpha << ", cosine " << cosine;
            }
}
TEST(LobeTable, anyIndexFrom1To3IsInterpolatedWithinTwoPercentOfItsReflectance) {
    expectIndicesFrom1To3();
}
TEST(LobeTableSlow, anyIndexFrom1To3IsInterpolatedWithinTwoPercentOfItsReflectance) {
    expectIndicesFrom1To3();
}

TEST(LobeTable, nothingIsReflectedWhereTheIndexIsOne) {
    EXPECT_EQ(shared::iorPlace(1.0f), float(LOBE_TABLE_IOR_ONE)) << "between two places others would be mixed in";
    for (const double alpha : {0.0, 0.3, 1.0})
        for (const double cosine : {0.01, 0.5, 1.0}) {
            EXPECT_LT(dielectricLookedUp(lobeTable(), 1.0, cosine, alpha), 1e-12);
            // Also just below 1, except where reflection is total.
            EXPECT_LT(dielectricLookedUp(lobeTable(), 0.99999, std::max(cosine, 0.5), alpha), 1e-6);
        }
}

/// Blinn's highlight (n.h)^p integrated over all lights, dl = 4 v.h dh, by rings of half vectors.
double reflectedByBlinn(double exponent, double cosView) {
    constexpr int kRings = 1000, kTurns = 256;
    const double sine = std::sqrt(1.0 - cosView * cosView), widest = std::min(0.5 * pi, 20.0 / std::sqrt(exponent));
    double sum = 0.0;
    for (int i = 0; i < kRings; ++i)
        for (int j = 0; j < kTurns; ++j) {
            const double away = widest * (i + 0.5) / kRings, turn = 2.0 * pi * (j + 0.5) / kTurns;
            const double cosHalf = std::cos(away);
            const double incidence = cosHalf * cosView + std::sin(away) * sine * std::cos(turn);
            if (incidence > 0.0 && 2.0 * incidence * cosHalf > cosView)
                sum += std::sin(away) * std::pow(cosHalf, exponent) * 4.0 * incidence;
        }
    return sum * (widest / kRings) * (2.0 * pi / kTurns);
}

/// Includes lobes narrower than any of the table.
TEST(LobeTable, blinnsHighlightIsInterpolatedWithinHalfAPercentAtAnyExponent) {
    const std::vector<glm::vec4>& table = lobeTable();
    for (const double exponent : {1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6, 1e9})
        for (const double cosine : {0.05, 0.15, 0.5, 0.9, 1.0}) {
            const double alpha = std::min(std::sqrt(2.0 / (exponent + 2.0)), 1.0); // lobeAlpha() of lobes.glsl
            const double reflected = double(lookedUp(table, cosine, alpha).z) / (exponent + 2.0);
            const double truth = reflectedByBlinn(exponent, cosine);
            EXPECT_NEAR(reflected, truth, 5e-3 * truth) << exponent << ", cosine " << cosine;
        }
}

/// A and B of the split sum by perceptual roughness and the viewer's cosine, shading.md section 6.
TEST(LobeTable, holdsThePublishedSplitSum) {
    const std::vector<glm::vec4>& table = lobeTable();
    constexpr double kRoughness[] = {0.25, 0.5, 0.75, 1.0}, kCosines[] = {0.1, 0.5, 1.0};
    constexpr double kA[4][3] = {
        {.5051, .9557, .9957}, {.7519, .8349, .9158}, {.7958, .6547, .6268}, {.7363, .4477, .3067}};
    constexpr double kB[4][3] = {{.3916, .0326, .0}, {.1397, .0223, .0}, {.0526, .0085, .0}, {.0239, .0030, .0}};
    for (int r = 0; r < 4; ++r)
        for (int m = 0; m < 3; ++m) {
            const glm::vec4 lobe = lookedUp(table, kCosines[m], kRoughness[r] * kRoughness[r]);
            EXPECT_NEAR(lobe.x - lobe.y, kA[r][m], 1e-3) << kRoughness[r] << ", " << kCosines[m];
            EXPECT_NEAR(lobe.y, kB[r][m], 1e-3) << kRoughness[r] << ", " << kCosines[m];
        }
}

/// Under uniform illumination a sheen reflects its directional albedo E. Layers below lose the larger of E at the light
/// and at the viewer (KHR_materials_sheen, "Albedo-scaling technique"): on average over the light, 2 max(E, E') c dc.
TEST(LobeTable, holdsWhatASheenReflectsAndOnTheMeanTakesFromBelow) {
    constexpr int kSteps = 2000;
    const std::vector<glm::vec4>& table = lobeTable();
    for (const double alpha : {0.16, 0.5, 1.0})
        for (const double cosine : {0.04, 0.2, 0.5, 1.0}) {
            const glm::vec4 found = interpolatedAt(table, glm::sqrt(glm::dvec2(cosine, alpha)), LOBE_LAYER_SHEEN);
            const double reflected = test::textbook::sheenEnergy(alpha, cosine);
            EXPECT_NEAR(found.x, reflected, 0.02 * reflected) << alpha << ", " << cosine;
            double taken = 0.0;
            for (int i = 0; i < kSteps; ++i) {
                const double cosLight = (i + 0.5) / kSteps;
                taken += std::max(reference::sheenAlbedo(alpha, cosLight), reference::sheenAlbedo(alpha, cosine)) *
                         2.0 * cosLight / kSteps;
            }
            EXPECT_NEAR(found.y, taken, 2e-3) << alpha << ", " << cosine;
        }
}

/// The cosine-weighted mean of (1 - v.h)^5 over lights. For a viewer along the normal, v.h is the cosine of half the
/// light's angle x: the mean of sin 2x (1 - cos x/2)^5 from 0 to pi/2 is the integral of 2 (1 - u)^5 (2 u^2 - 1) 4 u du
/// over u = cos x/2 from sqrt(1/2) to 1. Other viewers take polar angles.
TEST(LobeTable, holdsTheMeanOfSchlicksFactorOverLightFromEverywhere) {
    constexpr int kSteps = 400;
    double straight = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double u = std::lerp(std::sqrt(0.5), 1.0, (i + 0.5) / kSteps);
        straight += 8.0 * std::pow(1.0 - u, 5.0) * (2.0 * u * u - 1.0) * u * (1.0 - std::sqrt(0.5)) / kSteps;
    }
    EXPECT_NEAR(lookedUp(lobeTable(), 1.0, 0.5).w, straight, 2e-6); // the value is 8e-5
    for (const double cosine : {0.04, 0.3, 0.7}) {
        const double sine = std::sqrt(1.0 - cosine * cosine);
        double mean = 0.0;
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps; ++j) {
                const double away = 0.5 * pi * (i + 0.5) / kSteps, turn = pi * (j + 0.5) / kSteps;
                const double ofBoth = std::cos(away) * cosine + std::sin(away) * std::cos(turn) * sine;
                mean += std::pow(1.0 - std::sqrt(0.5 * (1.0 + ofBoth)), 5.0) * std::sin(2.0 * away) * 0.5 * pi /
                        (kSteps * kSteps);
            }
        EXPECT_NEAR(lookedUp(lobeTable(), cosine, 0.5).w, mean, 0.01 * mean) << cosine;
    }
}

} // namespace
} // namespace tessera::frame
