#include "scenes/Shadows.h"
#include "validation/reference/LightAt.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "renderer/frame/LightRange.h"
#include "tests/image/Textbook.h"
#include "tests/support/AreaLights.h"
#include "validation/reference/LightFace.h"

namespace tessera::reference {
namespace {

using scenes::Falloff;
using scenes::Light;
using scenes::LightType;

ShiningLight shining(const Light& light, const Settings& settings = {}) {
    scenes::Scene scene;
    scene.lights = {light};
    const std::vector<ShiningLight> lights = shiningLights(scene, settings, glm::dvec3(0.0));
    return lights.empty() ? ShiningLight{} : lights.front();
}

Light candela(float intensity, const glm::dvec3& positionWS) {
    Light light;
    light.intensity = intensity;
    light.positionWS = positionWS;
    return light;
}

TEST(ReferenceLight, aPointLightFallsWithTheSquareOfTheDistance) {
    const Incident incident = incidentAt(shining(candela(3.0f, {0, 2, 0})), {0, 0.5, 2});
    EXPECT_DOUBLE_EQ(incident.irradiance.g, 3.0 / 6.25);
    EXPECT_DOUBLE_EQ(incident.toLight.y, 0.6);
    EXPECT_DOUBLE_EQ(incident.toLight.z, -0.8);
}

TEST(ReferenceLight, everyLightIsTheTextbooks) {
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> value(-2.0, 2.0);
    for (int i = 0; i < 3000; ++i) {
        Light light = candela(2.5f, {value(engine), value(engine), value(engine)});
        light.color = {1.0f, 0.5f, 0.25f};
        light.type = LightType(i % 3);
        light.directionWS = glm::normalize(glm::dvec3(value(engine), value(engine), 2.5));
        light.innerConeRadians = 0.3f;
        light.outerConeRadians = 1.2f;
        if (i % 2 == 0) light.rangeMetres = 2.2f;
        if (i % 5 == 0) {
            light.falloff = Falloff::Attenuation;
            light.attenuation = {0.5f, 0.25f, 1.5f};
        }
        const glm::dvec3 positionWS(value(engine), value(engine), value(engine));
        glm::dvec3 toLightWS;
        const glm::dvec3 wanted = test::textbook::incident(light, positionWS, toLightWS);
        const Incident found = incidentAt(shining(light), positionWS);
        // The textbook computes a cone's cosines in single precision, an error that narrow cones magnify.
        if (light.type == LightType::Spot) light.type = LightType::Point;
        const double open = incidentAt(shining(light), positionWS).irradiance.r;
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(found.irradiance[c], wanted[c], 1e-6 * open) << i;
        if (wanted != glm::dvec3(0.0)) {
            ASSERT_LT(glm::distance(found.toLight, toLightWS), 1e-14);
        }
    }
}

TEST(ReferenceLight, atItsRangeAndBeyondALightIsExactlyZero) {
    Light light = candela(3.0f, {0, 0, 0});
    light.rangeMetres = 2.0f;
    EXPECT_EQ(incidentAt(shining(light), {0, 2, 0}).irradiance, glm::dvec3(0.0));
    EXPECT_EQ(incidentAt(shining(light), {0, 9, 0}).irradiance, glm::dvec3(0.0));
    const double open = 1.0 - 1.0 / 16.0;
    EXPECT_DOUBLE_EQ(incidentAt(shining(light), {0, 1, 0}).irradiance.r, 3.0 * open * open);
}

TEST(ReferenceLight, aConeClosesFromInnerToOuterAndAClosedOneLightsNothing) {
    Light light = candela(1.0f, {0, 0, 0});
    light.type = LightType::Spot;
    light.innerConeRadians = 0.2f;
    light.outerConeRadians = 0.6f;
    const auto at = [&](double angle) {
        return incidentAt(shining(light), {std::sin(angle), 0.0, -std::cos(angle)}).irradiance.r;
    };
    EXPECT_DOUBLE_EQ(at(0.1), 1.0);
    const double open = (std::cos(0.4) - std::cos(double(0.6f))) / (std::cos(double(0.2f)) - std::cos(double(0.6f)));
    EXPECT_NEAR(at(0.4), open * open, 1e-14);
    EXPECT_EQ(at(0.61), 0.0);
    light.innerConeRadians = light.outerConeRadians = 0.0f;
    EXPECT_EQ(at(0.0), 0.0);
}

/// docs/numerics.md, "Clamps and limits".
TEST(ReferenceLight, nearAndBrightLightsAndNarrowConesAreClampedAsTheDefinitionSays) {
    EXPECT_EQ(shining(candela(3e38f, {0, 0, 0})).color.r, 1e30);
    Light light = candela(3.0f, {0, 0, 0});
    light.attenuation = {0, 0, 1};
    for (const Falloff falloff : {Falloff::InverseSquare, Falloff::Attenuation}) {
        light.falloff = falloff;
        EXPECT_NEAR(incidentAt(shining(light), {0, 0.009, 0}).irradiance.r, 3.0 / 1e-4, 1e-8);
    }
    light = candela(1.0f, {0, 0, 0});
    light.type = LightType::Spot;
    light.innerConeRadians = light.outerConeRadians = 0.3f;
    const double cosine = std::cos(double(0.3f)) + 0.5 * 0.001; // half open
    EXPECT_NEAR(incidentAt(shining(light), {std::sqrt(1.0 - cosine * cosine), 0.0, -cosine}).irradiance.r, 0.25, 1e-12);
}

TEST(ReferenceLight, extremeLightsNeverSendNaNOrInfinity) {
    for (const float intensity : {1e-20f, 1e20f, 3e38f}) {
        for (const float range : {1e-20f, 1.0f, scenes::kInfinity}) {
            Light light = candela(intensity, {0, 0, 0});
            light.rangeMetres = range;
            for (const double metres : {0.0, 1e-30, 1e-6, 1.0, 1e30}) {
                const Incident incident = incidentAt(shining(light), {0, metres, 0});
                EXPECT_TRUE(std::isfinite(incident.irradiance.r) && std::isfinite(incident.toLight.y)) << metres;
            }
        }
    }
}

TEST(ReferenceLight, aToleranceEndsALightWhereTheProductEndsIt) {
    for (const glm::vec3 abc : {glm::vec3(0, 0, 1), glm::vec3(1, 0.5, 0), glm::vec3(0.5, 0.3, 0.6),
                                glm::vec3(1, 1e-4, 1e-8), glm::vec3(99.99, 0.1, 0.1)}) {
        Light light = candela(1.0f, {0, 0, 0});
        light.falloff = Falloff::Attenuation;
        light.attenuation = abc;
        for (const double tolerance : {1e-1, 1e-2, 1e-3}) {
            const double wanted = frame::reachMetres(light, tolerance);
            EXPECT_NEAR(rangeOf(light, 1.0, tolerance), wanted, 1e-12 * wanted) << tolerance;
        }
        EXPECT_EQ(rangeOf(light, 1.0, 0.0), double(scenes::kInfinity));
    }
}

// ---- Area lights ---------------------------------------------------------------------------------------------------

/// An area light 2 m above the origin, with 4 m2 visible from straight below; the tube has 2 m2 without its ends.
Light areaLight(LightType type) {
    Light light = candela(3.0f, {0, 0, 2});
    light.type = type;
    light.widthMetres = 2.0f;
    light.heightMetres = 2.0f;
    for (glm::vec2& corner : light.corners.metres) corner *= 2.0f;
    light.lengthMetres = 2.0f;
    light.radiusMetres = type == LightType::Tube ? 0.5f : 2.0f / std::sqrt(std::numbers::pi_v<float>);
    if (type == LightType::Tube) light.directionWS = {1, 0, 0};
    return light;
}

TEST(ReferenceLight, theIrradianceOfASmallAreaLightGoesWithItsProjectedArea) {
    // At the centre's distance of 2 m; limited to pi times the radiance.
    const auto given = [](double area) { return 3.0 * area / (4.0 + area / std::numbers::pi); };
    const auto at = [](Light light, double angle) {
        light.directionWS = {std::sin(angle), 0.0, -std::cos(angle)};
        return incidentAt(shining(light), {0, 0, 0}).irradiance.r;
    };
    for (const LightType type : test::kFlatTypes) {
        Light light = areaLight(type);
        EXPECT_NEAR(at(light, 0.0), given(4.0), 1e-6) << "the radius is rounded to fp32";
        EXPECT_NEAR(at(light, 1.0), given(4.0 * std::cos(1.0)), 1e-6);
        EXPECT_EQ(at(light, 2.0), 0.0);
        light.isTwoSided = true;
        EXPECT_NEAR(at(light, 2.0), given(-4.0 * std::cos(2.0)), 1e-6);
        light.rangeMetres = 4.0f;
        EXPECT_NEAR(at(light, 0.0), given(4.0) * std::pow(1.0 - 1.0 / 16.0, 2), 1e-6);
    }
    EXPECT_NEAR(at(areaLight(LightType::Sphere), 1.7), given(4.0), 1e-6);
    const double end = std::numbers::pi / 4.0;
    for (const double angle : {0.0, 0.4, 1.5, 2.5}) {
        const double area = 2.0 * std::sin(angle) + end * std::abs(std::cos(angle));
        EXPECT_NEAR(at(areaLight(LightType::Tube), angle), given(area), 1e-12) << angle;
    }
    // A near and large light gives at most a hemisphere of its radiance.
    Light vast = areaLight(LightType::Rectangle);
    vast.widthMetres = vast.heightMetres = 1e6f;
    EXPECT_NEAR(at(vast, 0.0), 3.0 * std::numbers::pi, 1e-9);
}

TEST(ReferenceLight, anAreaLightsRangeIsItsOwnOrWhereItsIrradianceIsBelowTheTolerance) {
    constexpr double kTolerance = 1e-3;
    Settings settings;
    settings.rangeTolerance = kTolerance;
    for (const LightType type : test::kAreaTypes) {
        SCOPED_TRACE(scenes::infoOf(type).name);
        Light light = areaLight(type);
        EXPECT_EQ(rangeOf(light, 3.0, 0.0), double(scenes::kInfinity));
        const double range = rangeOf(light, 3.0, kTolerance);
        EXPECT_DOUBLE_EQ(shining(light, settings).rangeMetres, range);
        // At that range the whole light, taken at the distance of its nearest point, gives just the tolerance.
        const double bound = scenes::infoOf(light.type).isTurned() ? std::sqrt(2.0)
                             : light.type == LightType::Tube       ? std::sqrt(1.25)
                                                                   : double(light.radiusMetres);
        const double area = type == LightType::Tube ? 2.0 + std::numbers::pi / 4.0 : 4.0;
        EXPECT_NEAR(3.0 * area / std::pow(range - bound, 2), kTolerance, 1e-9);
        EXPECT_NEAR(std::numbers::pi * std::pow(scenes::shadowRadiusMetres(light), 2), area, 1e-6);
        light.rangeMetres = 7.0f;
        EXPECT_EQ(rangeOf(light, 3.0, kTolerance), 7.0);
    }
}

/// A thin cut along the longest chord of a face takes the chord times its width of the area.
TEST(ReferenceLight, aThinCutOfAFaceTakesTheLongestChordOfItsArea) {
    constexpr double kMetres = 1e-3, kLean = 0.5;
    for (const LightType type : test::kAreaTypes) {
        SCOPED_TRACE(scenes::infoOf(type).name);
        const Light light = areaLight(type);
        const LightFace face(light, {0, 0, 1}, double(light.radiusMetres));
        const bool isSquare = type == LightType::Rectangle || type == LightType::Polygon;
        const double chord = isSquare ? 2.0 * std::sqrt(2.0) : 2.0 * double(light.radiusMetres);
        const double area = type == LightType::Tube ? std::numbers::pi * 0.25 : 4.0;
        EXPECT_NEAR(face.shareOfCut(kMetres, {0, 1, 0}), chord * kMetres / area, 1e-9);
        EXPECT_EQ(face.shareOfCut(10.0, {0, 1, 0}), 1.0);
        if (!scenes::infoOf(type).isFlat) continue;
        const glm::dvec3 leaning(0.0, std::sin(kLean), std::cos(kLean)); // cuts the plane in a wider strip
        EXPECT_NEAR(face.shareOfCut(kMetres, leaning), chord * kMetres / std::sin(kLean) / area, 1e-9);
    }
}

TEST(ReferenceLight, onlyLightsThatAreOnEverShine) {
    scenes::Scene scene;
    scene.lights = {candela(1.0f, {}), candela(2.0f, {}), candela(0.0f, {}), candela(4.0f, {})};
    scene.lights[1].enabled = false;
    Settings settings;
    EXPECT_EQ(shiningLights(scene, settings, {}).size(), 2u);
    settings.soloLight = 3;
    ASSERT_EQ(shiningLights(scene, settings, {}).size(), 1u);
    EXPECT_EQ(shiningLights(scene, settings, {}).front().color.r, 4.0);
}

} // namespace
} // namespace tessera::reference
