// Thin films of the reference, compared with closed forms for single waves, no film, and films too thick to interfere.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/Random.h"
#include "validation/reference/Film.h"

namespace tessera::reference {
namespace {

/// Reflectance at normal incidence, by Fresnel's equations.
double straightSide(double ior) {
    return (ior - 1.0) * (ior - 1.0) / ((ior + 1.0) * (ior + 1.0));
}

TEST(ReferenceFilm, ofNoThicknessLeavesWhatTheSurfaceReflects) {
    test::Random random(31);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 straight = glm::dvec3(random.unit(), random.unit(), random.unit()) * 0.6;
        // Light of more than four round trips in the film is omitted: an error below 1e-4 up to this index.
        const glm::dvec3 shown = filmReflectance(straight, 1.0, 1.0 + 0.4 * random.unit(), 0.0);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(shown[c], straight[c], 1e-4) << i;
    }
}

TEST(ReferenceFilm, withTheIndexOfAirIsNotSeen) {
    for (const double straight : {0.04, 0.5, 0.9})
        for (const double thicknessNm : {0.0, 100.0, 1000.0})
            EXPECT_NEAR(filmReflectance(glm::dvec3(straight), 1.0, 1.0, thicknessNm).g, straight, 1e-12);
}

/// The powers of both interfaces' light add up, over all round trips.
TEST(ReferenceFilm, tooThickToInterfereReflectsWhatBothSidesDo) {
    for (const double filmIor : {1.3, 1.8, 2.5})
        for (const double ior : {1.2, 1.5, 4.0}) {
            const double outer = straightSide(filmIor), inner = straightSide(ior / filmIor);
            const double wanted = (outer + inner - 2.0 * outer * inner) / (1.0 - outer * inner);
            for (const double thicknessNm : {5e3, 5e4, 1e9})
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(filmReflectance(glm::dvec3(straightSide(ior)), 1.0, filmIor, thicknessNm)[c], wanted,
                                1e-6)
                        << filmIor << ", " << ior << ", " << thicknessNm;
        }
}

/// An antireflective coating: with the mean index and a quarter wave of thickness, both interfaces cancel.
TEST(ReferenceFilm, aQuarterOfAWaveTakesTheReflectionFromGlass) {
    constexpr double kGreenNm = 1000.0 / 1.7953;
    const double filmIor = std::sqrt(1.5);
    const glm::dvec3 coated = filmReflectance(glm::dvec3(0.04), 1.0, filmIor, 0.25 * kGreenNm / filmIor);
    EXPECT_LT(coated.g, 0.001) << "of 0.04";
    EXPECT_GT(coated.b, 0.004) << "other colours stay";
    // Half a wave acts like no film for green.
    EXPECT_GT(filmReflectance(glm::dvec3(0.04), 1.0, filmIor, 0.5 * kGreenNm / filmIor).g, 0.03);
}

/// The mean reflectance over a normal distribution of wave numbers, by the trapezoidal rule.
double meanOver(double middle, double variance, const auto& reflectanceAt) {
    constexpr int kSteps = 400;
    constexpr double kDeviations = 6.0;
    double sum = 0.0, weights = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
        const double away = kDeviations * (2.0 * i / kSteps - 1.0), weight = std::exp(-0.5 * away * away);
        sum += weight * reflectanceAt(middle + away * std::sqrt(variance));
        weights += weight;
    }
    return sum / weights;
}

/// Airy's closed form of a wave for infinitely many round trips: |a + b z|^2 / |1 + a b z|^2 of the two interfaces'
/// amplitudes and the phase between them. The sensitivities are those of Belcour and Barla 2017, per micrometre.
glm::dvec3 airysColor(double straight, double cosine, double filmIor, double thicknessNm) {
    const auto grazing = [](double ofStraight, double c) {
        return ofStraight + (1.0 - ofStraight) * std::pow(1.0 - c, 5.0);
    };
    const double root = std::sqrt(straight), ior = (1.0 + root) / (1.0 - root);
    const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (filmIor * filmIor));
    // Amplitudes of s-polarised light are negative at a denser medium.
    const double a = -std::sqrt(grazing(straightSide(filmIor), cosine));
    const double b = (ior > filmIor ? -1.0 : 1.0) * std::sqrt(grazing(straightSide(ior / filmIor), inside));
    const double wayMicrometres = 2.0 * filmIor * inside * thicknessNm / 1000.0;
    const auto reflectance = [&](double waveNumber) {
        const std::complex<double> z = std::polar(1.0, 2.0 * std::numbers::pi * wayMicrometres * waveNumber);
        return std::norm((a + b * z) / (1.0 + a * b * z));
    };
    const double first = 5.4856 * std::sqrt(4.3278), second = 0.97470 * std::sqrt(4.5282); // weights of x's two lobes
    const glm::dvec3 xyz((first * meanOver(1.6810, 2.0 * 4.3278e-3, reflectance) +
                          second * meanOver(2.2399, 2.0 * 4.5282e-3, reflectance)) /
                             (first + second),
                         meanOver(1.7953, 2.0 * 9.3046e-3, reflectance),
                         meanOver(2.2084, 2.0 * 6.6121e-3, reflectance));
    const glm::dvec3 rows[] = {{3.2404542, -1.5371385, -0.4985314},
                               {-0.9692660, 1.8760108, 0.0415560},
                               {0.0556434, -0.2040259, 1.0572252}}; // IEC 61966-2-1
    glm::dvec3 color(0.0);
    for (int c = 0; c < 3; ++c) color[c] = glm::dot(rows[c], xyz) / glm::dot(rows[c], glm::dvec3(1.0)); // white is 1
    return glm::clamp(color, 0.0, 1.0);
}

/// Light of more than four round trips is omitted: 6e-4 and, on a metal, 0.018.
TEST(ReferenceFilm, isAirysClosedFormAtAnyThicknessAndAngle) {
    double apart = 0.0;
    for (const double straight : {0.04, 0.3, 0.9})
        for (const double filmIor : {1.2, 1.4, 1.9, 2.4})
            for (const double cosine : {1.0, 0.6, 0.3})
                for (const double thicknessNm : {50.0, 150.0, 400.0, 800.0}) {
                    const glm::dvec3 shown = filmReflectance(glm::dvec3(straight), cosine, filmIor, thicknessNm);
                    const glm::dvec3 wanted = airysColor(straight, cosine, filmIor, thicknessNm);
                    for (int c = 0; c < 3; ++c)
                        EXPECT_NEAR(shown[c], wanted[c], straight < 0.5 ? 1e-3 : 2e-2)
                            << straight << ", " << filmIor << ", " << cosine << ", " << thicknessNm << " nm, " << c;
                    apart = std::max(apart, std::abs(wanted.r - wanted.b));
                }
    EXPECT_GT(apart, 0.3) << "in colour";
}

/// Sums beyond these bounds are clamped, so only NaN can fail.
TEST(ReferenceFilm, reflectsBetweenNothingAndAll) {
    test::Random random(32);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 straight(random.unit(), 1.0, i % 2 == 0 ? 0.0 : random.unit());
        const glm::dvec3 shown = filmReflectance(straight, 0.1 + 0.9 * random.unit(), 1.0 + 3.0 * random.unit(),
                                                 3000.0 * random.unit() * random.unit());
        for (int c = 0; c < 3; ++c) ASSERT_TRUE(shown[c] >= 0.0 && shown[c] <= 1.0) << i << ": " << shown[c];
    }
}

} // namespace
} // namespace tessera::reference
