#include "scenes/Scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "tests/unit/scenes/TinyScene.h"

namespace tessera::scenes {
namespace {

/// Rounding of a handful of double operations on numbers near 10.
constexpr double kRounding = 1e-14;

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    EXPECT_LE(glm::distance(a, b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

Light animatedLight(LightAnimationKind kind) {
    Light light;
    light.positionWS = {3.0, 1.0, 0.0};
    LightAnimation& animation = light.animation.emplace();
    animation.kind = kind;
    animation.periodSeconds = 4.0;
    return light;
}

LightKeys keysOf(LightKeyed of, std::vector<glm::dvec3> values) {
    LightKeys keys;
    keys.of = of;
    for (std::size_t i = 0; i < values.size(); ++i) keys.timesSeconds.push_back(2.0 * double(i));
    keys.values = std::move(values);
    return keys;
}

TEST(Scene, childTransformsAreAppliedBeforeTheirParents) {
    Scene scene = tinyScene();
    scene.nodes[0].parentFromNode = glm::scale(glm::dmat4(1.0), glm::dvec3(2.0));
    Node child;
    child.parent = 0;
    child.parentFromNode = glm::translate(glm::dmat4(1.0), glm::dvec3(1.0, 0.0, 0.0));
    child.instances.push_back({0, 0});
    scene.nodes.push_back(child);

    EXPECT_EQ(glm::dvec3(worldFromNodes(scene)[1] * glm::dvec4(0.0, 0.0, 0.0, 1.0)), glm::dvec3(2.0, 0.0, 0.0));
    const Box3 boundsWS = worldBounds(scene);
    EXPECT_EQ(boundsWS.min, glm::dvec3(0.0));
    EXPECT_EQ(boundsWS.max, glm::dvec3(6.0, 8.0, 0.0));
    EXPECT_EQ(triangleCount(scene), 2u);
}

TEST(Scene, boundsNeverCountVerticesThatNoTriangleUses) {
    Scene scene = tinyScene();
    scene.meshes[0].positionsOS.emplace_back(100.0f);
    scene.meshes[0].normalsOS.emplace_back(0.0f, 0.0f, 1.0f);
    EXPECT_EQ(worldBounds(scene).max, glm::dvec3(2.0, 4.0, 0.0));
    scene.nodes.clear();
    EXPECT_TRUE(worldBounds(scene).empty());
}

TEST(LightAnimation, orbitTurnsCounterClockwiseAroundItsAxis) {
    Light light = animatedLight(LightAnimationKind::Orbit);
    light.animation->centerWS = {1.0, 0.0, 0.0};
    light.animation->axisWS = {0.0, 5.0, 0.0}; // any length
    expectNear(lightAtTime(light, 0.0).positionWS, {3.0, 1.0, 0.0}, kRounding);
    expectNear(lightAtTime(light, 1.0).positionWS, {1.0, 1.0, -2.0}, kRounding);
    expectNear(lightAtTime(light, 2.0).positionWS, {-1.0, 1.0, 0.0}, kRounding);
    expectNear(lightAtTime(light, -1.0).positionWS, {1.0, 1.0, 2.0}, kRounding);
    light.animation->phase = 0.25;
    expectNear(lightAtTime(light, 0.0).positionWS, {1.0, 1.0, -2.0}, kRounding);
}

TEST(LightAnimation, wobbleAddsAmplitudeTimesTheSineOfTheTime) {
    Light light = animatedLight(LightAnimationKind::Wobble);
    light.animation->amplitudeMetres = {0.5, 1.0, 0.0};
    expectNear(lightAtTime(light, 1.0).positionWS, {3.5, 2.0, 0.0}, kRounding);
    expectNear(lightAtTime(light, 0.5).positionWS, {3.0 + 0.5 * std::sqrt(0.5), 1.0 + std::sqrt(0.5), 0.0}, kRounding);
}

TEST(LightAnimation, pathRunsAtConstantSpeedAndCloses) {
    Light light = animatedLight(LightAnimationKind::Path);
    // Sides of 3, 4 and 5 m: 3 m per second.
    light.animation->pointsWS = {{0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {3.0, 4.0, 0.0}};
    expectNear(lightAtTime(light, 0.5).positionWS, {1.5, 0.0, 0.0}, kRounding);
    expectNear(lightAtTime(light, 2.0).positionWS, {3.0, 3.0, 0.0}, kRounding);
    expectNear(lightAtTime(light, 3.5).positionWS, {0.9, 1.2, 0.0}, kRounding);
    expectNear(lightAtTime(light, 4.0).positionWS, {0.0, 0.0, 0.0}, kRounding);
    light.animation->pointsWS.assign(2, {1.0, 2.0, 3.0});
    EXPECT_EQ(lightAtTime(light, 1.0).positionWS, glm::dvec3(1.0, 2.0, 3.0));
}

TEST(LightAnimation, keyframesAreClampedAtTheirEnds) {
    Light light = animatedLight(LightAnimationKind::Keyframes);
    light.animation->keys.timesSeconds = {1.0, 2.0, 4.0};
    light.animation->keys.values = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 8.0, 0.0}};
    EXPECT_EQ(lightAtTime(light, -9.0).positionWS, glm::dvec3(0.0));
    EXPECT_EQ(lightAtTime(light, 1.5).positionWS, glm::dvec3(0.5, 0.0, 0.0));
    EXPECT_EQ(lightAtTime(light, 2.0).positionWS, glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_EQ(lightAtTime(light, 2.5).positionWS, glm::dvec3(1.0, 2.0, 0.0));
    EXPECT_EQ(lightAtTime(light, 99.0).positionWS, glm::dvec3(1.0, 8.0, 0.0));
}

TEST(LightAnimation, stepsKeepEachPointUntilTheNextKey) {
    Light light = animatedLight(LightAnimationKind::Keyframes);
    light.animation->keys.interpolation = Interpolation::Step;
    light.animation->keys.timesSeconds = {1.0, 2.0};
    light.animation->keys.values = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
    EXPECT_EQ(lightAtTime(light, 1.999).positionWS, glm::dvec3(0.0));
    EXPECT_EQ(lightAtTime(light, 2.0).positionWS, glm::dvec3(1.0, 0.0, 0.0));
}

TEST(LightAnimation, splinesFollowACubicWhoseSlopesAreTheirTangents) {
    Light light = animatedLight(LightAnimationKind::Keyframes);
    light.animation->keys.interpolation = Interpolation::CubicSpline;
    light.animation->keys.timesSeconds = {1.0, 3.0, 4.0};
    const auto cubic = [](double t) { return glm::dvec3(t * t * t, 2.0 - t, t * t); };
    for (const double t : light.animation->keys.timesSeconds) {
        light.animation->keys.values.push_back(cubic(t));
        light.animation->keys.inTangents.emplace_back(3.0 * t * t, -1.0, 2.0 * t);
    }
    light.animation->keys.outTangents = light.animation->keys.inTangents;
    for (const double t : {1.0, 1.25, 2.0, 2.9, 3.0, 3.5, 4.0})
        expectNear(lightAtTime(light, t).positionWS, cubic(t), 1e-12); // rounding of numbers up to 64
    EXPECT_EQ(lightAtTime(light, 1e9).positionWS, cubic(4.0));
}

TEST(LightAnimation, keyframesLoopOrTurnBackBeyondTheirEnds) {
    Light light = animatedLight(LightAnimationKind::Keyframes);
    light.animation->keys.timesSeconds = {1.0, 3.0};
    light.animation->keys.values = {{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}};
    const auto xAt = [&](double seconds) { return lightAtTime(light, seconds).positionWS.x; };
    light.animation->keys.repeat = KeyRepeat::Loop;
    EXPECT_EQ(xAt(2.5), 1.5);
    EXPECT_EQ(xAt(3.0), 0.0);
    EXPECT_EQ(xAt(3.5), 0.5);
    EXPECT_EQ(xAt(0.5), 1.5);
    EXPECT_EQ(xAt(1e9 + 1.5), 0.5);
    light.animation->keys.repeat = KeyRepeat::PingPong;
    EXPECT_EQ(xAt(2.5), 1.5);
    EXPECT_EQ(xAt(3.0), 2.0);
    EXPECT_EQ(xAt(3.5), 1.5);
    EXPECT_EQ(xAt(0.5), 0.5);
    EXPECT_EQ(xAt(5.5), 0.5);
    EXPECT_EQ(xAt(1e9 + 1.5), 0.5);
    light.animation->keys.timesSeconds = {1.0};
    light.animation->keys.values.resize(1);
    EXPECT_EQ(xAt(7.0), 0.0) << "one key is a place";
}

TEST(LightAnimation, openPathsGoThereAndBackAtConstantSpeed) {
    Light light = animatedLight(LightAnimationKind::Path);
    light.animation->periodSeconds = 14.0;
    light.animation->isOpen = true;
    light.animation->pointsWS = {{0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {3.0, 4.0, 0.0}};
    expectNear(lightAtTime(light, 1.0).positionWS, {1.0, 0.0, 0.0}, kRounding);
    expectNear(lightAtTime(light, 5.0).positionWS, {3.0, 2.0, 0.0}, kRounding);
    expectNear(lightAtTime(light, 7.0).positionWS, {3.0, 4.0, 0.0}, kRounding);
    expectNear(lightAtTime(light, 13.0).positionWS, {1.0, 0.0, 0.0}, kRounding);
}

/// A spot light on a path; a period of 1 s, so that seconds are fractions of it.
Light lightOnPath(std::vector<glm::dvec3> pointsWS, PathLine line) {
    Light light = animatedLight(LightAnimationKind::Path);
    light.type = LightType::Spot;
    light.animation->periodSeconds = 1.0;
    light.animation->pointsWS = std::move(pointsWS);
    light.animation->line = line;
    return light;
}

TEST(LightAnimation, curvesRoundASquareAreThoseOfTheirClosedForm) {
    // For equidistant points, a slope is half the difference of the neighbours: here (1, -1) and (1, 1). The middle of
    // the lower side is (0, -1) + ((1, -1) - (1, 1)) / 8.
    const Light light =
        lightOnPath({{-1.0, -1.0, 0.0}, {1.0, -1.0, 0.0}, {1.0, 1.0, 0.0}, {-1.0, 1.0, 0.0}}, PathLine::CatmullRom);
    for (int i = 0; i < 4; ++i) // all sides are of one length
        expectNear(lightAtTime(light, 0.25 * i).positionWS, light.animation->pointsWS[std::size_t(i)], 1e-12);
    expectNear(lightAtTime(light, 0.125).positionWS, {0.0, -1.25, 0.0}, 1e-12);
    expectNear(lightAtTime(light, 0.625).positionWS, {0.0, 1.25, 0.0}, 1e-12);
    // Constant speed, up to chords of a 64th of a side: equal time steps are equally long.
    double least = 1e9, most = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const double metres =
            glm::distance(lightAtTime(light, i / 1000.0).positionWS, lightAtTime(light, (i + 1) / 1000.0).positionWS);
        least = std::min(least, metres);
        most = std::max(most, metres);
    }
    EXPECT_GT(least, 0.97 * most);
}

TEST(LightAnimation, curvesThroughPointsOnALineAreTheLine) {
    // Distances of 1, 4 and 9 m: slopes differ with the roots of the distances, but positions stay on the line.
    Light light =
        lightOnPath({{0.0, 2.0, 0.0}, {1.0, 2.0, 0.0}, {5.0, 2.0, 0.0}, {14.0, 2.0, 0.0}}, PathLine::CatmullRom);
    light.animation->isOpen = true;
    double x = 0.0;
    for (int i = 1; i <= 50; ++i) {
        const glm::dvec3 placeWS = lightAtTime(light, i / 100.0).positionWS;
        EXPECT_NEAR(placeWS.y, 2.0, kRounding);
        EXPECT_NEAR(placeWS.x, 14.0 * i / 50.0, 1e-2) << "constant speed, but for chords";
        EXPECT_GT(placeWS.x, x) << "never back";
        x = placeWS.x;
    }
    expectNear(lightAtTime(light, 0.5).positionWS, {14.0, 2.0, 0.0}, 1e-12);
    expectNear(lightAtTime(light, 0.75).positionWS, lightAtTime(light, 0.25).positionWS, 1e-12);
}

TEST(LightAnimation, curvesPassThroughAllPointsAlsoWhereSomeAreTheSame) {
    Light light = lightOnPath({{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {3.0, 1.0, 0.0}, {2.0, 5.0, 1.0}, {2.0, 5.0, 1.0}},
                              PathLine::CatmullRom);
    for (const bool isOpen : {false, true}) {
        light.animation->isOpen = isOpen;
        for (const glm::dvec3& pointWS : light.animation->pointsWS) {
            double nearest = 1e9;
            for (int i = 0; i < 2000; ++i)
                nearest = std::min(nearest, glm::distance(lightAtTime(light, i / 2000.0).positionWS, pointWS));
            EXPECT_LT(nearest, 1e-2) << isOpen; // a step of about 16 m / 2000
        }
    }
}

TEST(LightAnimation, lightsThatLookAheadFaceTheWayTheyGo) {
    for (const PathLine line : {PathLine::Straight, PathLine::CatmullRom})
        for (const bool isOpen : {false, true}) {
            Light light = lightOnPath({{0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {3.0, 4.0, 1.0}}, line);
            light.animation->isOpen = isOpen;
            EXPECT_EQ(lightAtTime(light, 0.1).directionWS, light.directionWS) << "only those that look ahead";
            light.animation->looksAhead = true;
            for (const double share : {0.05, 0.2, 0.35, 0.62, 0.9}) {
                constexpr double kStep = 1e-5;
                const glm::dvec3 stepWS =
                    lightAtTime(light, share + kStep).positionWS - lightAtTime(light, share - kStep).positionWS;
                const glm::dvec3 directionWS = lightAtTime(light, share).directionWS;
                EXPECT_NEAR(glm::length(directionWS), 1.0, kRounding);
                EXPECT_GT(glm::dot(glm::normalize(stepWS), directionWS), 1.0 - 1e-6) << isOpen << ' ' << share;
            }
        }
    Light light = lightOnPath({{0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}}, PathLine::Straight);
    light.animation->looksAhead = true;
    EXPECT_EQ(lightAtTime(light, 0.2).directionWS, glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_EQ(lightAtTime(light, 0.7).directionWS, glm::dvec3(-1.0, 0.0, 0.0));
    light.keyframes = {keysOf(LightKeyed::Direction, {{0.0, 1.0, 0.0}})};
    EXPECT_EQ(lightAtTime(light, 0.2).directionWS, glm::dvec3(1.0, 0.0, 0.0)) << "whatever keyframes say";
}

TEST(LightAnimation, anyTimeIsTheSameModuloThePeriod) {
    Light light = animatedLight(LightAnimationKind::Orbit);
    // 2^40 s is a whole number of periods of 4 s, exactly representable with its fraction.
    expectNear(lightAtTime(light, std::ldexp(1.0, 40) + 1.25).positionWS, lightAtTime(light, 1.25).positionWS,
               kRounding);
}

/// More turns than a double counts, or infinitely many.
TEST(LightAnimation, timesFarBeyondThePeriodLeaveLightsInTheirPlace) {
    for (const LightAnimationKind kind : {LightAnimationKind::Orbit, LightAnimationKind::Wobble,
                                          LightAnimationKind::Path, LightAnimationKind::Keyframes}) {
        Light light = animatedLight(kind);
        light.animation->periodSeconds = 1e-300;
        light.animation->amplitudeMetres = {1.0, 2.0, 3.0};
        light.animation->pointsWS = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
        light.animation->keys.values = light.animation->pointsWS;
        light.animation->keys.timesSeconds = {0.0, 1e-300};
        light.animation->keys.repeat = KeyRepeat::PingPong;
        light.flicker.emplace().frequencyHz = LightFlicker::kMostHertz;
        for (const double seconds : {1e10, -1e10, 1e300, -1e308}) {
            const Light then = lightAtTime(light, seconds);
            EXPECT_LT(glm::length(then.positionWS), 100.0) << int(kind) << " at " << seconds; // not NaN either
            EXPECT_TRUE(std::isfinite(then.intensity)) << seconds;
        }
    }
}

TEST(LightAnimation, flickerKeepsItsMeanAndItsBounds) {
    for (const int seed : {0, 1, 77}) {
        const LightFlicker flicker{.amplitude = 1.0, .frequencyHz = 4.0, .seed = seed};
        constexpr int kSteps = 1024; // 16 per turn of the fastest part: sums of sines vanish up to rounding
        double sum = 0.0, least = 9.0, most = 0.0;
        for (int i = 0; i < kSteps; ++i) {
            const double factor = flickerAt(flicker, 16.0 * i / kSteps);
            EXPECT_EQ(factor, flickerAt(flicker, 16.0 * i / kSteps + 16.0 * 1048576.0)) << "and repeats";
            sum += factor;
            least = std::min(least, factor);
            most = std::max(most, factor);
        }
        EXPECT_NEAR(sum / kSteps, 1.0, 1e-12);
        EXPECT_GE(least, 0.0);
        EXPECT_LE(most, 2.0);
        EXPECT_GT(most - least, 0.5) << "it does flicker";
    }
}

TEST(LightAnimation, flickerScalesTheIntensityOfEveryType) {
    Light light;
    light.intensity = 10.0f;
    light.flicker = LightFlicker{.amplitude = 0.5, .frequencyHz = 3.0, .seed = 5};
    LightFlicker other = *light.flicker;
    other.seed = 6;
    EXPECT_NE(flickerAt(*light.flicker, 0.3), flickerAt(other, 0.3));
    for (const LightTypeInfo& type : lightTypes()) {
        light.type = type.type;
        EXPECT_EQ(lightAtTime(light, 1e9).intensity, float(10.0 * flickerAt(*light.flicker, 1e9))) << type.name;
    }
    light.flicker->amplitude = 0.0;
    EXPECT_EQ(lightAtTime(light, 0.3).intensity, 10.0f);
}

TEST(LightKeys, directionsTurnAlongGreatCirclesAtConstantSpeed) {
    Light light;
    light.type = LightType::Directional;
    light.keyframes = {keysOf(LightKeyed::Direction, {{1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}})};
    for (const double share : {0.0, 0.1, 1.0 / 3.0, 0.5, 0.9, 1.0}) {
        const double angle = 0.5 * std::numbers::pi * share;
        expectNear(lightAtTime(light, 2.0 * share).directionWS, {std::cos(angle), -std::sin(angle), 0.0}, kRounding);
    }
    light.keyframes[0].values[1] = {-1.0, 0.0, 0.0}; // turns in any plane, at constant speed
    for (const double share : {0.0, 0.25, 0.5, 1.0}) {
        const glm::dvec3 directionWS = lightAtTime(light, 2.0 * share).directionWS;
        EXPECT_NEAR(glm::length(directionWS), 1.0, kRounding);
        EXPECT_NEAR(directionWS.x, std::cos(std::numbers::pi * share), kRounding);
    }
    light.keyframes[0].values[1] = light.keyframes[0].values[0];
    EXPECT_EQ(lightAtTime(light, 0.7).directionWS, glm::dvec3(1.0, 0.0, 0.0));
}

TEST(LightKeys, splinesOfDirectionsStayOfUnitLength) {
    Light light;
    light.type = LightType::Spot;
    LightKeys keys = keysOf(LightKeyed::Direction, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}});
    keys.interpolation = Interpolation::CubicSpline;
    keys.inTangents = keys.outTangents = {glm::dvec3(0.0), glm::dvec3(0.0)};
    light.keyframes = {keys};
    expectNear(lightAtTime(light, 1.0).directionWS, glm::dvec3(1.0, 1.0, 0.0) * std::sqrt(0.5), kRounding);
    // With zero slopes, the weights at a quarter are 1 - 3/16 + 2/64 = 27/32 and 5/32.
    expectNear(lightAtTime(light, 0.5).directionWS, glm::normalize(glm::dvec3(27.0, 5.0, 0.0)), kRounding);
    light.keyframes[0].values[1] = {-1.0, 0.0, 0.0};
    EXPECT_EQ(lightAtTime(light, 1.0).directionWS, glm::dvec3(1.0, 0.0, 0.0)) << "in the middle there is none";
}

TEST(LightKeys, whatIsTurnedTurnsWithItsDirection) {
    Light light;
    light.type = LightType::Rectangle;
    light.directionWS = {0.0, 0.0, -1.0};
    light.alongWS = {1.0, 0.0, 0.0};
    light.keyframes = {keysOf(LightKeyed::Direction, {{0.0, 0.0, -1.0}, {1.0, 0.0, 0.0}})};
    for (const double seconds : {0.0, 0.5, 1.0, 1.9, 2.0}) {
        const Light then = lightAtTime(light, seconds);
        EXPECT_NEAR(glm::dot(then.alongWS, then.directionWS), 0.0, kRounding) << seconds;
        EXPECT_NEAR(glm::length(then.alongWS), 1.0, kRounding) << seconds;
    }
    expectNear(lightAtTime(light, 1.0).alongWS, glm::dvec3(1.0, 0.0, 1.0) * std::sqrt(0.5), kRounding);
}

TEST(LightKeys, coloursAndIntensitiesAreLinearAndNeverNegative) {
    Light light;
    light.color = {0.25f, 0.25f, 0.25f};
    light.flicker = LightFlicker{.amplitude = 0.5, .frequencyHz = 3.0, .seed = 5};
    light.keyframes = {keysOf(LightKeyed::Color, {{0.0, 1.0, 0.5}, {1.0, 0.0, 0.5}}),
                       keysOf(LightKeyed::Intensity, {{4.0, 0.0, 0.0}, {8.0, 0.0, 0.0}})};
    const Light then = lightAtTime(light, 0.5);
    EXPECT_EQ(then.color, glm::vec3(0.25f, 0.75f, 0.5f));
    EXPECT_EQ(then.intensity, float(5.0 * flickerAt(*light.flicker, 0.5))) << "flicker multiplies";
    EXPECT_EQ(then.positionWS, light.positionWS);
    EXPECT_EQ(then.directionWS, light.directionWS);
    light.flicker.reset();
    for (LightKeys& keys : light.keyframes) {
        keys.interpolation = Interpolation::CubicSpline;
        keys.outTangents.assign(2, glm::dvec3(-100.0));
        keys.inTangents.assign(2, glm::dvec3(0.0));
    }
    EXPECT_EQ(lightAtTime(light, 0.5).intensity, 0.0f) << "a spline that dips below 0";
    EXPECT_EQ(lightAtTime(light, 0.5).color, glm::vec3(0.0f));
    EXPECT_EQ(lightAtTime(light, 2.0).intensity, 8.0f);
}

TEST(LightKeys, whatATypeLacksIsNeverChanged) {
    for (const LightTypeInfo& type : lightTypes()) {
        Light light;
        light.type = type.type;
        light.keyframes = {keysOf(LightKeyed::Direction, {{0.0, 1.0, 0.0}})};
        EXPECT_EQ(lightAtTime(light, 1.0).directionWS != light.directionWS, type.hasDirection) << type.name;
        EXPECT_TRUE(movesByItself(light));
    }
}

TEST(LightAnimation, directionalAndStillLightsNeverMove) {
    Light light = animatedLight(LightAnimationKind::Wobble);
    light.animation->amplitudeMetres = glm::dvec3(1.0);
    light.type = LightType::Directional;
    EXPECT_EQ(lightAtTime(light, 1.0).positionWS, light.positionWS);
    light.type = LightType::Spot;
    light.animation.reset();
    EXPECT_EQ(lightAtTime(light, 1.0).positionWS, light.positionWS);
}

} // namespace
} // namespace tessera::scenes
