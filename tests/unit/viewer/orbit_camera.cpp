#include "viewer/camera/OrbitCamera.h"

#include "tests/unit/viewer/CameraTest.h"
#include "viewer/camera/Damping.h"

namespace tessera::viewer {
namespace {

using namespace test;

struct OrbitRig {
    scenes::Camera lens;
    OrbitCamera orbit;
    explicit OrbitRig(const scenes::Camera& camera) : lens(camera), orbit(poseOf(camera, kBox), camera) {}
    scenes::Camera shown() const { return cameraAt(orbit.pose(), lens); }
    void settle() { orbit.advance(kLongSeconds, kHeightPixels); }
};

std::vector<scenes::Camera> lenses() {
    return {perspective({1, 2, 8}, {0, 1, 0}), perspective({1, 2, 8}, {0, 1, 0}, {0.5, 1, 0}, 100.0),
            orthographic({1, 2, 8}, {0, 1, 0}, 3.0)};
}

/// The point at the pivot's depth under a pixel.
glm::dvec3 pointUnder(const OrbitRig& rig, const glm::dvec2& pixels) {
    const CameraPose pose = rig.orbit.pose();
    const double metres = metresPerPixel(rig.lens, pose, pose.focusMetres, kHeightPixels);
    return rig.orbit.pivotWS() + metres * (pixels.x * pose.heading.rightWS() - pixels.y * pose.heading.upWS());
}

TEST(OrbitCamera, panningKeepsThePointUnderTheCursor) {
    for (const scenes::Camera& lens : lenses()) {
        OrbitRig rig(lens);
        const glm::dvec3 pointWS = pointUnder(rig, {40.0, -70.0});
        rig.orbit.pan({120.0, 55.0}, kHeightPixels);
        rig.settle();
        const glm::dvec3 shown = shownAt(rig.shown(), pointWS);
        EXPECT_NEAR(shown.x, 160.0, 1e-6);
        EXPECT_NEAR(shown.y, -15.0, 1e-6);
    }
}

TEST(OrbitCamera, zoomingKeepsThePointUnderTheCursorAlsoOnTheWay) {
    for (const scenes::Camera& lens : lenses()) {
        OrbitRig rig(lens);
        const glm::dvec3 pointWS = pointUnder(rig, {300.0, 200.0});
        rig.orbit.zoom(0.5, {300.0, 200.0}, kHeightPixels);
        for (int i = 0; i < 60; ++i) {
            rig.orbit.advance(0.01, kHeightPixels);
            const glm::dvec3 shown = shownAt(rig.shown(), pointWS);
            EXPECT_NEAR(shown.x, 300.0, 1e-6);
            EXPECT_NEAR(shown.y, 200.0, 1e-6);
        }
        const double apart = shownAt(rig.shown(), pointUnder(rig, {0, 0}) + rig.shown().worldFromCamera[0].x).x;
        EXPECT_NE(apart, 0.0);
    }
}

TEST(OrbitCamera, zoomingByAFactorIsExactlyMultiplicative) {
    OrbitRig rig(lenses()[0]);
    const double before = rig.orbit.pose().focusMetres;
    for (int i = 0; i < 2; ++i) rig.orbit.zoom(0.5, {}, kHeightPixels);
    rig.settle();
    EXPECT_DOUBLE_EQ(rig.orbit.pose().focusMetres, 0.25 * before);
    rig.orbit.zoom(4.0, {}, kHeightPixels);
    rig.settle();
    EXPECT_DOUBLE_EQ(rig.orbit.pose().focusMetres, before);
    OrbitRig parallel(lenses()[2]);
    parallel.orbit.zoom(0.5, {}, kHeightPixels);
    parallel.settle();
    EXPECT_DOUBLE_EQ(parallel.orbit.pose().halfHeightMetres, 1.5);
}

TEST(OrbitCamera, zoomingFarBeyondTheLimitsNeverReachesThePivotOrInfinity) {
    OrbitRig rig(lenses()[0]);
    for (int i = 0; i < 2000; ++i) rig.orbit.zoom(0.5, {}, kHeightPixels);
    rig.settle();
    EXPECT_GT(rig.orbit.pose().focusMetres, 0.0);
    for (int i = 0; i < 4000; ++i) rig.orbit.zoom(2.0, {}, kHeightPixels);
    rig.settle();
    EXPECT_TRUE(std::isfinite(rig.orbit.pose().focusMetres));
}

TEST(OrbitCamera, rotatingTakesTheFrontOfABallHalfAsHighAsThePictureAlong) {
    for (const scenes::Camera& lens : lenses()) {
        OrbitRig rig(lens);
        const CameraPose pose = rig.orbit.pose();
        const double halfHeight = metresPerPixel(rig.lens, pose, pose.focusMetres, 2.0);
        const double radius =
            std::min(0.5 * halfHeight,
                     lens.projection == scenes::Projection::Perspective ? 0.5 * pose.focusMetres : 0.5 * halfHeight);
        const glm::dvec3 frontWS = rig.orbit.pivotWS() - radius * pose.heading.forwardWS();
        rig.orbit.rotate({3.0, -2.0}, kHeightPixels);
        rig.settle();
        EXPECT_NE(rig.orbit.pose().eyeWS, pose.eyeWS);
        const glm::dvec3 shown = shownAt(rig.shown(), frontWS);
        // Small angles: the error is about the angle of rotation, 0.01, times the drag.
        EXPECT_NEAR(shown.x, 3.0, 0.06);
        EXPECT_NEAR(shown.y, -2.0, 0.06);
        EXPECT_NEAR(glm::distance(glm::dvec3(rig.shown().worldFromCamera[3]), rig.orbit.pivotWS()), pose.focusMetres,
                    1e-12);
    }
}

TEST(OrbitCamera, twoHalfStepsAreOneStep) {
    OrbitRig one(lenses()[1]), two(lenses()[1]);
    for (OrbitRig* rig : {&one, &two}) {
        rig->orbit.rotate({300.0, 100.0}, kHeightPixels);
        rig->orbit.pan({200.0, 0.0}, kHeightPixels);
        rig->orbit.zoom(0.3, {10.0, 20.0}, kHeightPixels);
    }
    one.orbit.advance(0.1, kHeightPixels);
    for (int i = 0; i < 10; ++i) two.orbit.advance(0.01, kHeightPixels);
    EXPECT_FALSE(one.orbit.isAtRest());
    expectSamePicture(one.shown(), two.shown(), 1e-7); // rounding
    EXPECT_NEAR(one.orbit.pose().focusMetres, two.orbit.pose().focusMetres, 1e-12);
}

TEST(OrbitCamera, restIsReachedAndTheLastJumpIsNotVisible) {
    OrbitRig rig(lenses()[0]);
    EXPECT_TRUE(rig.orbit.isAtRest());
    rig.orbit.rotate({400.0, 100.0}, kHeightPixels);
    rig.orbit.zoom(0.7, {}, kHeightPixels);
    EXPECT_FALSE(rig.orbit.isAtRest());
    const glm::dvec3 cornerWS = pointUnder(rig, {500.0, 500.0});
    int steps = 0;
    glm::dvec3 before(0.0);
    for (; !rig.orbit.isAtRest() && steps < 1000; ++steps) {
        before = shownAt(rig.shown(), cornerWS);
        rig.orbit.advance(0.001, kHeightPixels);
    }
    EXPECT_LT(steps, 1000) << "one second is more than twelve dampings";
    const glm::dvec3 after = shownAt(rig.shown(), cornerWS);
    EXPECT_LT(glm::distance(glm::dvec2(before), glm::dvec2(after)), 1.0);
    EXPECT_EQ(rig.orbit.pose(), rig.orbit.goal());
}

} // namespace
} // namespace tessera::viewer
