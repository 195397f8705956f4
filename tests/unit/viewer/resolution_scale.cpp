#include <gtest/gtest.h>

#include "viewer/show/ResolutionScale.h"

namespace tessera::viewer {
namespace {

constexpr double kTargetMs = 45.0;

/// Draws frames with these costs of pixels and geometry at the scales requested; returns the last frame's time.
double lastMs(ResolutionScale& scale, double wholeMs, double fixedMs, int frames) {
    double ms = 0.0;
    for (int i = 0; i < frames; ++i) {
        const double side = scale.next();
        ms = fixedMs + wholeMs * side * side;
        scale.drew(side, ms);
    }
    return ms;
}

TEST(ResolutionScale, aSlowSceneIsWithinTheTargetAfterThreeFrames) {
    for (const double wholeMs : {60.0, 200.0, 800.0, 2000.0}) {
        for (const double fixedMs : {0.0, 8.0, 12.0}) {
            ResolutionScale scale(kTargetMs);
            scale.restart(1.0);
            // The first frame gives the cost of pixels, the second the fixed cost, a third corrects the line.
            lastMs(scale, wholeMs, fixedMs, 3);
            EXPECT_LE(lastMs(scale, wholeMs, fixedMs, 1), kTargetMs) << wholeMs << " + " << fixedMs;
        }
    }
}

TEST(ResolutionScale, aQuickSceneIsDrawnWholeInTheEnd) {
    ResolutionScale scale(kTargetMs);
    scale.restart(kScales.back());
    lastMs(scale, 20.0, 5.0, 60);
    EXPECT_EQ(scale.next(), 1.0);
}

TEST(ResolutionScale, theScaleNeverFlickersWhileTheCostStays) {
    ResolutionScale scale(kTargetMs);
    scale.restart(0.25);
    lastMs(scale, 500.0, 12.0, 60);
    const double settled = scale.next();
    for (int i = 0; i < 60; ++i) {
        lastMs(scale, 500.0, 12.0, 1);
        EXPECT_EQ(scale.next(), settled);
    }
}

TEST(ResolutionScale, picturesNeverLosePixelsWhereThatGainsNothing) {
    ResolutionScale scale(kTargetMs);
    lastMs(scale, 4.0, 120.0, 60);
    EXPECT_EQ(scale.next(), 1.0);
}

TEST(ResolutionScale, onePictureThatFillsWhatLaterOnesFindNeverKeepsThemWhole) {
    ResolutionScale scale(kTargetMs);
    scale.restart(kScales.back());
    scale.drew(1.0, 585.0);            // static
    scale.drew(kScales.back(), 600.0); // draws shadow maps too
    lastMs(scale, 580.0, 5.0, 10);
    EXPECT_LE(lastMs(scale, 580.0, 5.0, 1), kTargetMs);
}

TEST(ResolutionScale, aLargerPictureThatTakesLessPutsOutWhatIsKnownOfSmallerOnes) {
    ResolutionScale scale(kTargetMs);
    scale.restart(kScales.back());
    for (int i = 0; i < 3; ++i) scale.drew(kScales.back(), 375.0); // each draws shadow maps too
    scale.drew(1.0, 160.0);
    lastMs(scale, 155.0, 5.0, 8);
    EXPECT_LE(lastMs(scale, 155.0, 5.0, 1), kTargetMs);
}

TEST(ResolutionScale, itReportsWhatAWholePictureWouldTake) {
    ResolutionScale scale(kTargetMs);
    EXPECT_EQ(scale.predictedMs(1.0), 0.0) << "nothing is known";
    scale.drew(0.25, 100.0);
    EXPECT_NEAR(scale.predictedMs(1.0), 1600.0, 1.0) << "as if pixels were all that costs";
    scale.drew(0.5, 220.0);
    EXPECT_NEAR(scale.predictedMs(1.0), 700.0, 1.0);
}

TEST(ResolutionScale, aSceneThatNothingMakesQuickIsDrawnAtTheSmallestStep) {
    ResolutionScale scale(kTargetMs);
    lastMs(scale, 1e6, 1e2, 20);
    EXPECT_EQ(scale.next(), kScales.back());
}

} // namespace
} // namespace tessera::viewer
