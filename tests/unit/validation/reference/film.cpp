// Thin films of the reference: against closed forms for single waves, no film, and films too thick to interfere.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/Random.h"
#include "validation/reference/Film.h"

namespace tessera::reference {
namespace {

/// Fresnel's equations at normal incidence.
double straightSide(double ior) {
    return (ior - 1.0) * (ior - 1.0) / ((ior + 1.0) * (ior + 1.0));
}

TEST(ReferenceFilm, ofNoThicknessLeavesWhatTheSurfaceReflects) {
    test::Random random(31);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 straight = glm::dvec3(random.unit(), random.unit(), random.unit()) * 0.6;
        // Of light that goes back and forth more than four times nothing is summed: below 1e-4 up to this index.
        const glm::dvec3 shown = filmReflectance(straight, 1.0, 1.0 + 0.4 * random.unit(), 0.0);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(shown[c], straight[c], 1e-4) << i;
    }
}

TEST(ReferenceFilm, withTheIndexOfAirIsNotSeen) {
    for (const double straight : {0.04, 0.5, 0.9})
        for (const double thicknessNm : {0.0, 100.0, 1000.0})
            EXPECT_NEAR(filmReflectance(glm::dvec3(straight), 1.0, 1.0, thicknessNm).g, straight, 1e-12);
}

/// Both sides' light adds up by its power, over all ways back and forth.
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

/// The coating of lenses: of the mean index and a quarter of a wave thick, both sides cancel.
TEST(ReferenceFilm, aQuarterOfAWaveTakesTheReflectionFromGlass) {
    constexpr double kGreenNm = 1000.0 / 1.7953;
    const double filmIor = std::sqrt(1.5);
    const glm::dvec3 coated = filmReflectance(glm::dvec3(0.04), 1.0, filmIor, 0.25 * kGreenNm / filmIor);
    EXPECT_LT(coated.g, 0.001) << "of 0.04";
    EXPECT_GT(coated.b, 0.004) << "other colours stay";
    // Half a wave is as none for green.
    EXPECT_GT(filmReflectance(glm::dvec3(0.04), 1.0, filmIor, 0.5 * kGreenNm / filmIor).g, 0.03);
}

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
