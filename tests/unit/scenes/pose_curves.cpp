// Interpolation between the keys of a clip.
#include <chrono>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "scenes/Pose.h"

namespace tessera::scenes {
namespace {

std::vector<double> sampled(const AnimationSampler& sampler, double timeSeconds, bool isRotation = false) {
    std::vector<double> value(std::size_t(sampler.width));
    valueAt(sampler, isRotation, timeSeconds, value);
    return value;
}

double oneAt(const AnimationSampler& sampler, double timeSeconds) {
    return sampled(sampler, timeSeconds).front();
}

TEST(PoseCurves, stepKeepsAKeyUntilTheNextAndLinearMovesEvenly) {
    AnimationSampler sampler{Interpolation::Step, 1, {1.0f, 2.0f, 4.0f}, {10.0f, 20.0f, 40.0f}};
    EXPECT_EQ(oneAt(sampler, 1.999), 10.0);
    EXPECT_EQ(oneAt(sampler, 2.0), 20.0);
    EXPECT_EQ(oneAt(sampler, 3.9), 20.0);
    sampler.interpolation = Interpolation::Linear;
    EXPECT_DOUBLE_EQ(oneAt(sampler, 1.25), 12.5);
    EXPECT_DOUBLE_EQ(oneAt(sampler, 3.0), 30.0);
}

TEST(PoseCurves, timesOutsideOfTheKeysAreClampedHoweverFar) {
    for (const Interpolation interpolation : {Interpolation::Step, Interpolation::Linear}) {
        const AnimationSampler sampler{interpolation, 1, {1.0f, 2.0f}, {10.0f, 20.0f}};
        for (const double early : {1.0, 0.0, -1.0, -1e9}) EXPECT_EQ(oneAt(sampler, early), 10.0);
        for (const double late : {2.0, 3.0, 1e9, 1e300}) EXPECT_EQ(oneAt(sampler, late), 20.0);
    }
    const AnimationSampler spline{Interpolation::CubicSpline, 1, {1.0f, 2.0f}, {9, 10, 9, 9, 20, 9}};
    EXPECT_EQ(oneAt(spline, -5.0), 10.0);
    EXPECT_EQ(oneAt(spline, 1.0), 10.0);
    EXPECT_EQ(oneAt(spline, 2.0), 20.0);
    EXPECT_EQ(oneAt(spline, 5.0), 20.0);
}

TEST(PoseCurves, oneKeyIsAConstant) {
    for (const double time : {-1.0, 0.5, 7.0}) {
        EXPECT_EQ(oneAt({Interpolation::Linear, 1, {0.5f}, {3.0f}}, time), 3.0);
        EXPECT_EQ(oneAt({Interpolation::CubicSpline, 1, {0.5f}, {8.0f, 3.0f, 9.0f}}, time), 3.0);
    }
}

TEST(PoseCurves, aSplineFollowsACubicWithItsTangents) {
    // t^3 - 2 t on [0, 2] has the slopes -2 and 10.
    const AnimationSampler sampler{Interpolation::CubicSpline, 1, {0.0f, 2.0f}, {99, 0, -2, 10, 4, 99}};
    for (const double t : {0.25, 0.5, 1.0, 1.75}) EXPECT_NEAR(oneAt(sampler, t), t * t * t - 2.0 * t, 1e-12) << t;
}

TEST(PoseCurves, rotationsTurnTheShortWayAtConstantSpeed) {
    const double pi = std::numbers::pi;
    // From 0 to 90 degrees about y; the second key has the other sign, which is the same rotation.
    const auto s = float(std::sin(pi / 4.0));
    const AnimationSampler sampler{Interpolation::Linear, 4, {0.0f, 1.0f}, {0, 0, 0, 1, 0, -s, 0, -s}};
    for (const double share : {0.1, 0.5, 0.9}) {
        const std::vector<double> q = sampled(sampler, share, true);
        EXPECT_NEAR(std::abs(q[1]), std::sin(share * pi / 4.0), 1e-7);
        EXPECT_NEAR(std::abs(q[3]), std::cos(share * pi / 4.0), 1e-7);
        EXPECT_GT(q[1] * q[3], 0.0);
    }
}

TEST(PoseCurves, rotationsOfAnyLengthBecomeUnitQuaternions) {
    for (const Interpolation interpolation : {Interpolation::Step, Interpolation::Linear, Interpolation::CubicSpline}) {
        AnimationSampler sampler{interpolation, 4, {0.0f, 1.0f}, {0, 0, 0, 5, 1e-30f, 0, 0, 1e-30f}};
        if (interpolation == Interpolation::CubicSpline)
            sampler.values = {0, 0, 0, 0, 0, 0, 0, 5, 7, 7, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0};
        for (const double time : {0.0, 0.3, 1.0}) {
            double square = 0.0;
            for (const double number : sampled(sampler, time, true)) square += number * number;
            EXPECT_NEAR(square, 1.0, 1e-12);
        }
    }
}

TEST(PoseCurves, aHundredThousandKeysAreSearchedInNoTime) {
    AnimationSampler sampler{Interpolation::Linear, 1, {}, {}};
    for (int i = 0; i < 100'000; ++i) {
        sampler.timesSeconds.push_back(float(i));
        sampler.values.push_back(float(i));
    }
    const auto start = std::chrono::steady_clock::now();
    double sum = 0.0;
    for (int i = 0; i < 100'000; ++i) sum += oneAt(sampler, i + 0.5) - i;
    EXPECT_NEAR(sum, 100'000 * 0.5, 1.0);
    // Some 10 ms with a binary search, minutes with a linear one.
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 5.0);
}

} // namespace
} // namespace tessera::scenes
