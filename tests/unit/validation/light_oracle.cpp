#include "validation/culling/LightOracle.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "renderer/culling/TileGrid.h"
#include "shaders/shared/culling.h"

namespace tessera::validation {
namespace {

using std::numbers::pi;

scenes::Light lightAt(const glm::dvec3& positionWS, float rangeMetres) {
    scenes::Light light;
    light.positionWS = positionWS;
    light.rangeMetres = rangeMetres;
    return light;
}

/// Shines colour x intensity / (A + B d + C d^2).
scenes::Light fallingOffByABC(const glm::dvec3& positionWS, float intensity, const glm::vec3& abc) {
    scenes::Light light = lightAt(positionWS, 0.0f); // its range does not count
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
    moving.animation->timesSeconds = {0.0, 1.0};
    moving.animation->pointsWS = {{0.0, 0.0, 5.0}, {0.0, 0.0, -5.0}};
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
    // The second pixel's centre, half a picture height of 1 m right of the middle times the aspect of 2.
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
    // Four metres ahead, the picture is 8 m high and 12 m wide, so pixels lie 4 m apart.
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

// The test that lists are built by (shaders/shared/culling.h), at its edges, where it must still say yes. Numbers are
// such that fp32 holds them exactly.

TEST(LightTouch, aTileIsExactlyTheCentresOfItsPixels) {
    const glm::vec4 rayFromPixel(0.25f, 0.5f, 3.0f, 2.0f);
    const glm::uvec2 size(13u, 9u);
    const auto rays = [&](unsigned column, unsigned row) {
        return shared::tileRays(rayFromPixel, column, row, 4u, size);
    };
    // Tile (1, 0) has the columns 4 to 7 and the rows 5 to 8 from below.
    EXPECT_EQ(rays(1, 0),
              glm::vec4(0.25f * (4.5f - 3.0f), 0.25f * (7.5f - 3.0f), 0.5f * (5.5f - 2.0f), 0.5f * (8.5f - 2.0f)));
    // The last tile has one column and one row.
    EXPECT_EQ(rays(3, 2), glm::vec4(0.25f * 9.5f, 0.25f * 9.5f, 0.5f * -1.5f, 0.5f * -1.5f));
}

TEST(LightTouch, aSphereThatJustMeetsAPlaneOfASlabTouchesIt) {
    // Planes through the eye with slopes -3/4 and 3/4: a point so far aside is 4/5 of that away.
    const glm::vec2 rays(-0.75f, 0.75f), eyeAtOrigin(0.0f, 1.0f), orthographic(1.0f, 0.0f);
    const auto touches = [&](float across, const glm::vec2& spread) {
        return shared::sphereTouchesSlab(across, shared::spreadAt(4.0f, spread), 1.0f,
                                         shared::slabBetween(rays, spread));
    };
    EXPECT_TRUE(touches(-4.25f, eyeAtOrigin));
    EXPECT_TRUE(touches(4.25f, eyeAtOrigin));
    EXPECT_FALSE(touches(-4.375f, eyeAtOrigin));
    EXPECT_FALSE(touches(4.375f, eyeAtOrigin));
    EXPECT_TRUE(touches(-1.75f, orthographic));
    EXPECT_TRUE(touches(1.75f, orthographic));
    EXPECT_FALSE(touches(-1.875f, orthographic));
    EXPECT_FALSE(touches(1.875f, orthographic));
}

TEST(LightTouch, aSphereThatJustMeetsADepthTouchesIt) {
    const auto touches = [](float z, float radius, float nearMetres, float farMetres) {
        return shared::sphereTouchesDepths(glm::vec4(0.0f, 0.0f, z, radius), nearMetres, farMetres);
    };
    EXPECT_TRUE(touches(2.0f, 1.0f, 3.0f, 4.0f));
    EXPECT_TRUE(touches(5.0f, 1.0f, 3.0f, 4.0f));
    EXPECT_FALSE(touches(1.875f, 1.0f, 3.0f, 4.0f));
    EXPECT_FALSE(touches(5.125f, 1.0f, 3.0f, 4.0f));
    // At the origin of lighting space, where the margin for rounding is 0 too.
    EXPECT_TRUE(touches(-1.0f, 1.0f, 0.0f, 1.0f));
    EXPECT_TRUE(touches(1.0f, 1.0f, -1.0f, 0.0f));
}

TEST(LightTouch, theDistanceOfAPointFromABoxIsThatOfTheNearestPoint) {
    const shared::CellBox box{glm::vec4(1, 2, 3, 0), glm::vec4(4, 6, 8, 0)};
    EXPECT_EQ(shared::squaredDistance(2.0f, 3.0f, 4.0f, box), 0.0f);
    EXPECT_EQ(shared::squaredDistance(-1.0f, 3.0f, 4.0f, box), 4.0f);
    EXPECT_EQ(shared::squaredDistance(7.0f, 3.0f, 4.0f, box), 9.0f);
    EXPECT_EQ(shared::squaredDistance(2.0f, 1.0f, 4.0f, box), 1.0f);
    EXPECT_EQ(shared::squaredDistance(2.0f, 10.0f, 4.0f, box), 16.0f);
    EXPECT_EQ(shared::squaredDistance(2.0f, 3.0f, 0.0f, box), 9.0f);
    EXPECT_EQ(shared::squaredDistance(2.0f, 3.0f, 13.0f, box), 25.0f);
    EXPECT_EQ(shared::squaredDistance(0.0f, 8.0f, 10.0f, box), 9.0f);
}

TEST(LightTouch, aConeTouchesBoxesWithinHalfADiagonal) {
    // Travels ahead from the origin, 45 degrees to each side.
    const float root = std::sqrt(0.5f);
    const shared::CullLight light{glm::vec4(0, 0, 0, 100), glm::vec4(0, 0, 0, root), glm::vec4(0, 0, 1, root)};
    const auto touches = [&](const glm::vec3& center, float halfSide) {
        return shared::coneTouchesBox(light, {glm::vec4(center - halfSide, 0.0f), glm::vec4(center + halfSide, 0.0f)});
    };
    EXPECT_TRUE(touches({0, 0, 8}, 0.25f));
    EXPECT_TRUE(touches({0, 0, 0.0625f}, 1e-3f)) << "a small box on the axis, near the apex";
    EXPECT_TRUE(touches({7.5f, 0, 8}, 1e-3f));
    EXPECT_FALSE(touches({8.5f, 0, 8}, 1e-3f));
    EXPECT_FALSE(touches({0, 0, -8}, 1.0f));
    // (9, 0, 8) is 1 / sqrt 2 = 0.707 away from the cone; a box's half diagonal is sqrt 3 times half its side.
    EXPECT_TRUE(touches({9, 0, 8}, 0.42f));
    EXPECT_FALSE(touches({9, 0, 8}, 0.4f));
}

TEST(LightTouch, aLightTouchesABoxExactlyWithinItsRadiusAndItsCone) {
    const shared::CellBox box{glm::vec4(1, 2, 3, 0), glm::vec4(4, 6, 8, 0)};
    const auto touches = [&](float radius, const glm::vec4& axis) { // three metres to the right of the box
        return shared::lightTouchesBox({glm::vec4(7, 3, 4, radius), glm::vec4(7, 3, 4, std::sqrt(0.5f)), axis}, box);
    };
    const glm::vec4 noCone(0, 0, 0, -2), left(-1, 0, 0, std::sqrt(0.5f)), right(1, 0, 0, std::sqrt(0.5f));
    EXPECT_TRUE(touches(3.0f, noCone));
    EXPECT_FALSE(touches(2.875f, noCone));
    EXPECT_TRUE(touches(3.0f, left));
    EXPECT_FALSE(touches(2.875f, left));
    EXPECT_FALSE(touches(3.0f, right));
}

TEST(LightTouch, theMarginForRoundingIsThatOfPositionsAndThatOfEvenDepthsTogether) {
    EXPECT_EQ(shared::roundingMargin(2.0f, {3.0f, 0.0f, 5.0f, 7.0f}), 2e-5f);
    EXPECT_EQ(shared::roundingMargin(0.0f, {3.0f, 0x1p21f, 5.0f, 7.0f}), 1.0f) << "eight times 2^-24 of 2^21 m";
    EXPECT_EQ(shared::roundingMargin(2.0f, {3.0f, 0x1p21f, 5.0f, 7.0f}), 2e-5f + 1.0f);
}

TEST(TileGrid, theFinestSlicesOfDepthAreAsDeepAsATileOfSixteenPixelsIsWide) {
    // Of keys, 2^23 cover a factor of two in distance, or an even interval; a slice covers 2^shift. All numbers are
    // powers of two, so the slice is exactly as deep, not only the nearest power of two.
    const auto finestShift = [](float pixelMetres, bool orthographic, float originMetres, float evenMetres) {
        shared::ViewConstants view{};
        view.sizePixels = {640, 360, 0, 0};
        view.rayFromPixel.y = pixelMetres;
        view.forwardLS.w = orthographic ? 1.0f : 0.0f;
        view.eyeLS.w = originMetres;
        view.depthKey.y = evenMetres;
        shared::LightingConstants lighting{};
        culling::setTileGrid(lighting, view, 16);
        return lighting.slices.x;
    };
    EXPECT_EQ(finestShift(0x1p-8f, false, 0.0f, 0.0f), 23u - 4u) << "1/16 of the distance: 2^4 slices";
    EXPECT_EQ(finestShift(0x1p-8f, false, 1024.0f, 512.0f), 23u - 3u) << "64 m in the middle: 2^3 of 512 m";
    EXPECT_EQ(finestShift(0x1p-8f, true, 1024.0f, 512.0f), 23u - 13u) << "1/16 m everywhere: 2^13 of 512 m";
    EXPECT_EQ(finestShift(0x1p-16f, true, 0.0f, 0x1p-8f), 23u - 4u) << "1/4096 m: 2^4 of 4 mm";
    EXPECT_EQ(finestShift(0x1p-40f, false, 0.0f, 0.0f), 5u) << "what packSlices() has room for";
    EXPECT_EQ(finestShift(1.0f, false, 0.0f, 0.0f), 22u) << "two slices where tiles are wider";
}

} // namespace
} // namespace tessera::validation
