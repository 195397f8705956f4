#include "validation/culling/LightOracle.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace tessera::validation {
namespace {

using std::numbers::pi;

scenes::Light lightAt(const glm::dvec3& positionWS, float rangeMetres) {
    scenes::Light light;
    light.positionWS = positionWS;
    light.rangeMetres = rangeMetres;
    return light;
}

/// A light of colour x intensity / (A + B d + C d^2).
scenes::Light fallingOffByABC(const glm::dvec3& positionWS, float intensity, const glm::vec3& abc) {
    scenes::Light light = lightAt(positionWS, 0.0f); // its range is ignored
    light.falloff = scenes::Falloff::Attenuation;
    light.intensity = intensity;
    light.attenuation = abc;
    return light;
}

/// One pixel that shows the point (0, 0, -5) of a surface facing the orthographic camera at the origin; all of the
/// scene's lights are visited.
class LightOracle : public ::testing::Test {
protected:
    LightOracle() {
        scenes::Camera camera;
        camera.projection = scenes::Projection::Orthographic;
        camera.nearMetres = 0.0;
        camera.farMetres = 10.0;
        scene_.cameras.push_back(camera);
        drawn_.depths = {camera.nearMetres, camera.farMetres};
        settings_.sizePixels = {1, 1};
    }

    LightOracleFigures judge() {
        drawn_.sceneIndex.clear();
        drawn_.depths = {scene_.cameras[0].nearMetres, scene_.cameras[0].farMetres};
        for (std::size_t i = 0; i < scene_.lights.size(); ++i) drawn_.sceneIndex.push_back(int(i));
        return judgeLights({scene_, settings_, drawn_, depth_, normalWS_});
    }
    std::uint64_t needed(const scenes::Light& light) {
        scene_.lights = {light};
        return judge().needed;
    }

    scenes::Scene scene_;
    frame::FrameSettings settings_;
    engine::DrawnLists drawn_;
    std::vector<float> depth_{0.5f}; // halfway from near to far
    std::vector<float> normalWS_{0.0f, 0.0f, 1.0f, 1.0f};
};

TEST_F(LightOracle, aLightIsNeededExactlyWhereItsDistanceIsBelowItsRange) {
    // A triangle of sides 3, 4 and 5: every number is exact.
    EXPECT_EQ(needed(lightAt({3.0, 0.0, -1.0}, 5.0f)), 0u);
    EXPECT_EQ(needed(lightAt({3.0, 0.0, -1.0}, std::nextafter(5.0f, 6.0f))), 1u);
    EXPECT_EQ(needed(lightAt({0.0, 0.0, -5.0}, 0.0f)), 0u) << "on the surface, but without a range";
    EXPECT_EQ(needed(lightAt({0.0, 0.0, -5.0}, 1e-3f)), 1u);
    EXPECT_EQ(needed(lightAt({0.0, 4.0, 0.0}, 1e3f)), 1u) << "the camera lies inside the light";
    EXPECT_EQ(needed(lightAt({0.0, 0.0, 20.0}, 26.0f)), 1u) << "the light lies behind the camera";
}

TEST_F(LightOracle, aSpotIsNeededExactlyInsideItsOuterCone) {
    // A cone's angle is a float, off by up to 1.2e-7 rad; a hundred times that is clear of the edge.
    constexpr double kClearRadians = 1e-5;
    for (const double outerDegrees : {0.1, 30.0, 89.9, 90.0, 120.0, 179.0}) {
        SCOPED_TRACE(outerDegrees);
        scenes::Light spot = lightAt({1.0, 0.0, -5.0}, 2.0f);
        spot.type = scenes::LightType::Spot;
        spot.outerConeRadians = float(outerDegrees * pi / 180.0);
        const auto turned = [&](double radians) { // from the direction to the point, which is -x
            spot.directionWS = {-std::cos(radians), std::sin(radians), 0.0};
            return spot;
        };
        EXPECT_EQ(needed(turned(0.0)), 1u);
        EXPECT_EQ(needed(turned(double(spot.outerConeRadians) - kClearRadians)), 1u);
        EXPECT_EQ(needed(turned(double(spot.outerConeRadians) + kClearRadians)), 0u);
        EXPECT_EQ(needed(turned(pi)), 0u);
        spot.rangeMetres = 1.0f;
        EXPECT_EQ(needed(turned(0.0)), 0u) << "in the cone, but out of range";
    }
    scenes::Light closed = lightAt({1.0, 0.0, -5.0}, 2.0f);
    closed.type = scenes::LightType::Spot;
    closed.directionWS = {-1.0, 0.0, 0.0};
    closed.outerConeRadians = 0.0f;
    EXPECT_EQ(needed(closed), 0u) << "a cone of no width";
}

TEST_F(LightOracle, aLightOfABCIsNeededExactlyWhereItsBrightestChannelIsAboveTheTolerance) {
    const glm::dvec3 fiveMetresAway(3.0, 0.0, -1.0); // by a triangle of sides 3, 4 and 5
    struct Case {
        const char* name;
        glm::vec3 abc;
        float atFiveMetres; ///< A + 5 B + 25 C: the intensity that falls to a tolerance of 1 there
    };
    constexpr Case kCases[] = {{"B alone", {0.0f, 2.0f, 0.0f}, 10.0f},
                               {"C alone", {0.0f, 0.0f, 1.0f}, 25.0f},
                               {"A and B", {3.0f, 2.0f, 0.0f}, 13.0f},
                               {"A, B and C", {1.0f, 2.0f, 3.0f}, 86.0f},
                               {"mostly A", {4096.0f, 0.0f, 1.0f}, 4121.0f}};
    for (const Case& by : kCases) {
        for (const float tolerance : {1.0f, 0.25f, 8.0f}) { // powers of two: their products are exact
            SCOPED_TRACE(testing::Message() << by.name << ", tolerance " << tolerance);
            settings_.rangeTolerance = double(tolerance);
            const float edge = tolerance * by.atFiveMetres, above = std::nextafter(edge, 2.0f * edge);
            EXPECT_EQ(needed(fallingOffByABC(fiveMetresAway, edge, by.abc)), 0u);
            EXPECT_EQ(needed(fallingOffByABC(fiveMetresAway, above, by.abc)), 1u);
            scenes::Light coloured = fallingOffByABC(fiveMetresAway, 2.0f * edge, by.abc);
            coloured.color = {0.25f, 0.5f, 0.125f};
            EXPECT_EQ(needed(coloured), 0u);
            coloured.color.z = 0.75f;
            EXPECT_EQ(needed(coloured), 1u);
        }
    }
    // Solved by hand: 1 + 2 d + 3 d^2 = 41 at d = (-1 + 11) / 3 = 10/3 m, straight before the surface.
    settings_.rangeTolerance = 1.0;
    EXPECT_EQ(needed(fallingOffByABC({0.0, 0.0, -5.0 + 10.0 / 3.0 - 1e-9}, 41.0f, {1.0f, 2.0f, 3.0f})), 1u);
    EXPECT_EQ(needed(fallingOffByABC({0.0, 0.0, -5.0 + 10.0 / 3.0 + 1e-9}, 41.0f, {1.0f, 2.0f, 3.0f})), 0u);
}

TEST_F(LightOracle, aLightOfABCThatIsNowhereAboveTheToleranceIsNotNeeded) {
    settings_.rangeTolerance = 0.5;
    const glm::dvec3 onTheSurfaceWS(0.0, 0.0, -5.0);
    EXPECT_EQ(needed(fallingOffByABC(onTheSurfaceWS, 3.0f, {6.0f, 1.0f, 1.0f})), 0u) << "0.5 at the light itself";
    EXPECT_EQ(needed(fallingOffByABC(onTheSurfaceWS, 3.001f, {6.0f, 1.0f, 1.0f})), 1u);
    EXPECT_EQ(judge().everywhere, 0u);
}

TEST_F(LightOracle, aLightOfABCReachesEverywhereExactlyWithoutAToleranceOrWithoutFalloff) {
    const glm::dvec3 farAwayWS(1e6, 0.0, 0.0);
    const auto everywhere = [&](const glm::vec3& abc, double tolerance) {
        settings_.rangeTolerance = tolerance;
        scene_.lights = {fallingOffByABC(farAwayWS, 1.0f, abc)};
        return judge().everywhere;
    };
    EXPECT_EQ(everywhere({1.0f, 2.0f, 3.0f}, 0.0), 1u);
    EXPECT_EQ(everywhere({2.0f, 0.0f, 0.0f}, 0.25), 1u) << "1/2 at every distance";
    EXPECT_EQ(everywhere({2.0f, 0.0f, 0.0f}, 0.75), 1u) << "it has no radius to end at, however dark";
    EXPECT_EQ(everywhere({2.0f, 1e-30f, 0.0f}, 0.25), 0u);
    EXPECT_EQ(everywhere({0.0f, 0.0f, 1e-30f}, 0.25), 0u);
}

TEST_F(LightOracle, aSpotOfABCIsNeededExactlyInsideItsConeAndAboveTheTolerance) {
    settings_.rangeTolerance = 1.0;
    scenes::Light spot = fallingOffByABC({1.0, 0.0, -5.0}, 2.0f, {0.0f, 0.0f, 1.0f}); // 2 > 1 at the surface
    spot.type = scenes::LightType::Spot;
    spot.outerConeRadians = float(pi / 6.0);
    spot.directionWS = {-1.0, 0.0, 0.0};
    EXPECT_EQ(needed(spot), 1u);
    spot.intensity = 1.0f;
    EXPECT_EQ(needed(spot), 0u) << "in the cone, but too dark";
    spot.intensity = 2.0f;
    spot.directionWS = {0.0, 0.0, 1.0};
    EXPECT_EQ(needed(spot), 0u) << "bright enough, but beside the cone";
}

TEST_F(LightOracle, anAreaLightIsNeededUpToItsRangeOrToWhereItCanCauseTheTolerance) {
    // 12 m^2 in a bounding sphere of 2.5 m; the surface is 5 m from its centre, so 2.5 m from the sphere.
    scenes::Light panel = lightAt({3.0, 0.0, -1.0}, 5.0f);
    panel.type = scenes::LightType::Rectangle;
    panel.widthMetres = 3.0f;
    panel.heightMetres = 4.0f;
    EXPECT_EQ(needed(panel), 0u);
    panel.rangeMetres = std::nextafter(5.0f, 6.0f);
    EXPECT_EQ(needed(panel), 1u);
    panel.rangeMetres = scenes::kInfinity;
    EXPECT_EQ(needed(panel), 0u);
    EXPECT_EQ(judge().everywhere, 1u);
    settings_.rangeTolerance = 12.0 / 6.25;
    EXPECT_EQ(needed(panel), 0u) << "exactly the tolerance";
    EXPECT_EQ(judge().everywhere, 0u);
    panel.intensity = std::nextafter(1.0f, 2.0f);
    EXPECT_EQ(needed(panel), 1u);
    panel.intensity = 1e-9f;
    panel.positionWS = {0.0, 0.0, -3.0};
    EXPECT_EQ(needed(panel), 1u) << "inside the ball nothing bounds it";
    panel.heightMetres = 0.0f;
    EXPECT_EQ(needed(panel), 0u);
}

TEST_F(LightOracle, aFlatLightIsNeededBeforeItsSurfaceAloneUnlessItShinesFromBothSides) {
    // The surface is 2 m from its centre, along -z.
    scenes::Light panel = lightAt({0.0, 0.0, -3.0}, 5.0f);
    panel.type = scenes::LightType::Rectangle;
    panel.widthMetres = panel.heightMetres = 1.0f;
    for (const float rangeMetres : {5.0f, scenes::kInfinity}) {
        panel.rangeMetres = rangeMetres;
        settings_.rangeTolerance = 1e-3; // limits lights without a range
        panel.isTwoSided = false;
        panel.directionWS = {0.0, 0.0, -1.0};
        EXPECT_EQ(needed(panel), 1u);
        panel.directionWS = {0.6, 0.0, -0.8};
        EXPECT_EQ(needed(panel), 1u);
        panel.directionWS = {1.0, 0.0, 0.0};
        EXPECT_EQ(needed(panel), 0u) << "in its plane";
        panel.directionWS = {0.6, 0.0, 0.8};
        EXPECT_EQ(needed(panel), 0u) << "behind it";
        panel.isTwoSided = true;
        EXPECT_EQ(needed(panel), 1u);
    }
    settings_.rangeTolerance = 0.0;
    for (const double towards : {-1.0, 1.0}) {
        panel.isTwoSided = false;
        panel.directionWS = {0.0, 0.0, towards};
        scene_.lights = {panel};
        EXPECT_EQ(judge().everywhere, 1u);
        EXPECT_EQ(judge().everywhereLit, towards < 0.0 ? 1u : 0u);
    }
}

TEST_F(LightOracle, anAreaLightIsLitWhereAnyPartOfItMayBeInFrontOfTheSurface) {
    scenes::Light ball = lightAt({0.0, 0.0, -6.0}, 5.0f); // its centre is a metre behind
    ball.type = scenes::LightType::Sphere;
    for (const bool isEndless : {false, true}) {
        if (isEndless) ball.rangeMetres = scenes::kInfinity;
        const auto lit = [&](float radius) {
            ball.radiusMetres = radius;
            scene_.lights = {ball};
            return isEndless ? judge().everywhereLit : judge().neededLit;
        };
        EXPECT_EQ(lit(0.999f), 0u);
        EXPECT_EQ(lit(1.001f), 1u);
    }
}

TEST_F(LightOracle, aLightIsNeededLitExactlyInFrontOfTheSurface) {
    scene_.lights = {lightAt({0.0, 0.0, -4.0}, 2.0f), lightAt({1.0, 0.0, -5.0}, 2.0f), lightAt({0.0, 0.0, -6.0}, 2.0f)};
    EXPECT_EQ(judge().needed, 3u);
    EXPECT_EQ(judge().neededLit, 1u) << "in front, in its plane, behind it";
    normalWS_[2] = -1.0f;
    EXPECT_EQ(judge().neededLit, 1u);
    normalWS_.clear();
    EXPECT_EQ(judge().neededLit, 0u) << "nothing is known of normals";
    EXPECT_FALSE(judge().litTightness());
}

TEST_F(LightOracle, lightsThatShineOnNothingAreNotNeeded) {
    const scenes::Light shining = lightAt({0.0, 0.0, -4.0}, 2.0f);
    scenes::Light off = shining, black = shining, weak = shining;
    off.enabled = false;
    black.color = glm::vec3(0.0f);
    weak.intensity = 0.0f;
    scene_.lights = {off, black, shining, weak};
    EXPECT_EQ(judge().needed, 1u);
    EXPECT_EQ(judge().evaluated, 4u) << "visited all the same";
    EXPECT_DOUBLE_EQ(*judge().tightness(), 4.0);
    settings_.soloLight = 0;
    EXPECT_EQ(judge().needed, 0u) << "the solo light is off";
    EXPECT_FALSE(judge().tightness());
    settings_.soloLight = 2;
    EXPECT_EQ(judge().needed, 1u);
}

TEST_F(LightOracle, aMovingLightIsWhereItIsAtTheFramesTime) {
    scenes::Light moving = lightAt({0.0, 0.0, 0.0}, 1.0f);
    moving.animation = scenes::LightAnimation{};
    moving.animation->kind = scenes::LightAnimationKind::Keyframes;
    moving.animation->keys.timesSeconds = {0.0, 1.0};
    moving.animation->keys.values = {{0.0, 0.0, 5.0}, {0.0, 0.0, -5.0}};
    EXPECT_EQ(needed(moving), 0u);
    settings_.timeSeconds = 1.0;
    EXPECT_EQ(needed(moving), 1u);
}

TEST_F(LightOracle, aSpotWithoutARangeIsLitInItsConeAlone) {
    scenes::Light spot = lightAt({0.0, 0.0, 0.0}, scenes::kInfinity);
    spot.type = scenes::LightType::Spot;
    spot.outerConeRadians = 0.5f;
    for (const double towards : {-1.0, 1.0}) {
        spot.directionWS = {0.0, 0.0, towards};
        scene_.lights = {spot};
        const LightOracleFigures figures = judge();
        EXPECT_EQ(figures.everywhere, 1u);
        EXPECT_EQ(figures.everywhereLit, towards < 0.0 ? 1u : 0u);
    }
}

TEST_F(LightOracle, lightsThatReachEverywhereAreNeededAndCountedApart) {
    scenes::Light sun;
    sun.type = scenes::LightType::Directional;
    const scenes::Light endless = lightAt({1e6, 0.0, 0.0}, scenes::kInfinity);
    scene_.lights = {sun, lightAt({0.0, 0.0, -4.0}, 2.0f), endless};
    const LightOracleFigures figures = judge();
    EXPECT_EQ(figures.everywhere, 2u);
    EXPECT_EQ(figures.everywhereLit, 2u) << "one shines along the view, one from 5 m before the plane";
    EXPECT_EQ(figures.needed, 1u);
    EXPECT_EQ(figures.evaluated, 1u);
    EXPECT_EQ(figures.evaluatedMax, 3u);
    EXPECT_EQ(figures.falseNegatives, 0u);

    drawn_.sceneIndex = {0, 1};
    const LightOracleFigures lacking = judgeLights({scene_, settings_, drawn_, depth_, normalWS_});
    EXPECT_EQ(lacking.falseNegatives, 1u);
    EXPECT_EQ(lacking.everywhere, 1u);
    ASSERT_TRUE(lacking.firstMissing);
    EXPECT_EQ(lacking.firstMissing->light, 2);
}

TEST_F(LightOracle, pixelsWithoutASurfaceAreNotCounted) {
    scene_.lights = {lightAt({0.0, 0.0, -4.0}, 2.0f)};
    settings_.sizePixels = {2, 1};
    depth_ = {0.0f, 0.5f};
    normalWS_ = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f};
    // The second pixel's centre is 1 m right of the middle: half the half height of 1 m, times the aspect of 2.
    scene_.lights[0].positionWS.x = 1.0;
    EXPECT_EQ(judge().covered, 1u);
    EXPECT_EQ(judge().needed, 1u);
    depth_ = {0.0f, 0.0f};
    EXPECT_EQ(judge().covered, 0u);
    EXPECT_EQ(judge().evaluated, 0u);
    EXPECT_EQ(judge().perPixel(judge().needed), 0.0);
}

TEST_F(LightOracle, aPixelsSurfaceIsWhereItsPerspectiveDepthSays) {
    scenes::Camera& camera = scene_.cameras[0];
    camera.projection = scenes::Projection::Perspective;
    camera.fovYRadians = pi / 2.0;
    camera.nearMetres = 0.5;
    // Turned to look along +x and moved: camera (x, y, -z) is world (10 + z, y, x).
    camera.worldFromCamera = glm::dmat4(0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 10, 0, 0, 1);
    settings_.sizePixels = {3, 2};
    normalWS_.clear();
    // Four metres ahead, the image is 8 m high and 12 m wide, so pixels lie 4 m apart.
    for (const bool endless : {true, false}) {
        camera.farMetres = endless ? std::numeric_limits<double>::infinity() : 8.0;
        // Reverse-Z, a + b/z with 1 at near and 0 at far: n/z, or n (f - z) / (z (f - n)).
        const float depth = endless ? 0.5f / 4.0f : 0.5f * (8.0f - 4.0f) / (4.0f * (8.0f - 0.5f));
        for (int pixel = 0; pixel < 6; ++pixel) {
            SCOPED_TRACE(pixel);
            depth_.assign(6, 0.0f);
            depth_[std::size_t(pixel)] = depth;
            const glm::dvec3 surfaceWS(14.0, pixel < 3 ? -2.0 : 2.0, 4.0 * (pixel % 3 - 1));
            // A float depth is off by at most 2^-25 of itself, which is less than 1e-7 m here.
            EXPECT_EQ(needed(lightAt(surfaceWS, 1e-5f)), 1u);
            EXPECT_EQ(needed(lightAt(surfaceWS + glm::dvec3(1e-4, 0.0, 0.0), 1e-5f)), 0u);
        }
    }
    settings_.eyeOffsetWS = {0.0, 1.0, 0.0};
    EXPECT_EQ(needed(lightAt({14.0, 3.0, 4.0}, 1e-5f)), 1u) << "the eye is moved by a metre, and the surface with it";
}

TEST_F(LightOracle, theMissingPairIsNamedByItsPixelFromTheTopLeft) {
    settings_.sizePixels = {2, 3};
    depth_ = {0.0f, 0.5f, 0.0f, 0.0f, 0.0f, 0.0f}; // the lower right pixel
    normalWS_.clear();
    scene_.lights = {lightAt({0.0, 0.0, -5.0}, 0.01f), lightAt({0.0, 0.0, -5.0}, 5.0f)};
    const LightOracleFigures figures = judgeLights({scene_, settings_, drawn_, depth_, normalWS_});
    EXPECT_EQ(figures.falseNegatives, 1u);
    ASSERT_TRUE(figures.firstMissing);
    EXPECT_EQ(figures.firstMissing->x, 1);
    EXPECT_EQ(figures.firstMissing->y, 2);
    EXPECT_EQ(figures.firstMissing->light, 1);
}

} // namespace
} // namespace tessera::validation
