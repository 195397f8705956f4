#include "scenes/AreaLight.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "scenes/Shadows.h"
#include "tests/support/Random.h"

namespace tessera::scenes {
namespace {

TEST(AreaLight, isDarkExactlyWithoutASurface) {
    Light light;
    light.radiusMetres = 0.5f;
    const auto with = [&](LightType type, float Light::*member, float metres) {
        Light changed = light;
        changed.type = type;
        changed.*member = metres;
        return hasSurface(changed);
    };
    EXPECT_FALSE(hasSurface(light)) << "a point light, whose radius only softens shadows";
    for (const auto& [type, member] :
         {std::pair{LightType::Rectangle, &Light::widthMetres}, std::pair{LightType::Rectangle, &Light::heightMetres},
          std::pair{LightType::Disk, &Light::radiusMetres}, std::pair{LightType::Sphere, &Light::radiusMetres},
          std::pair{LightType::Tube, &Light::radiusMetres}, std::pair{LightType::Tube, &Light::lengthMetres}}) {
        EXPECT_FALSE(with(type, member, 0.0f));
        EXPECT_FALSE(with(type, member, 0.9e-6f));
        EXPECT_TRUE(with(type, member, 1e-6f));
    }
}

TEST(AreaLight, itsShadowsSeeADiskOfTheAreaThatItShowsAtMost) {
    Light light;
    light.radiusMetres = 0.5f;
    EXPECT_EQ(shadowRadiusMetres(light), 0.5);
    light.widthMetres = 4.0f;
    light.lengthMetres = 3.0f;
    for (const LightTypeInfo& info : lightTypes()) {
        light.type = info.type;
        EXPECT_EQ(hasSize(light), info.hasPosition()) << info.name;
        if (!info.isArea) continue;
        const double radius = shadowRadiusMetres(light);
        EXPECT_NEAR(tessera::test::pi * radius * radius, largestSeenArea(light), 1e-12) << info.name;
        EXPECT_LE(radius, surfaceReachMetres(light)) << info.name;
    }
    light.type = LightType::Rectangle;
    EXPECT_DOUBLE_EQ(largestSeenArea(light), 4.0);
    light.type = LightType::Tube;
    EXPECT_DOUBLE_EQ(largestSeenArea(light), 2.0 * 0.5 * 3.0 + tessera::test::pi * 0.25);
    EXPECT_DOUBLE_EQ(surfaceReachMetres(light), std::hypot(0.5, 1.5));
}

/// The part of a light's surface that faces a point, as small pieces: each with its solid angle.
double solidAngleFrom(const Light& light, const glm::dvec3& from) {
    constexpr int kSteps = 60;
    double sum = 0.0;
    const auto add = [&](const glm::dvec3& at, const glm::dvec3& out, double area) {
        const glm::dvec3 way = at - from;
        const double facing = -glm::dot(way, out);
        if (facing > 0.0) sum += area * facing / std::pow(glm::length(way), 3.0);
    };
    const glm::dvec3 axis = light.directionWS, u = usualAlong(axis), v = glm::cross(axis, u);
    const double radius = light.radiusMetres, half = 0.5 * double(light.lengthMetres);
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
            const double s = (i + 0.5) / kSteps, t = (j + 0.5) / kSteps, angle = 2.0 * tessera::test::pi * t;
            const glm::dvec3 ring = u * std::cos(angle) + v * std::sin(angle);
            const double piece = 1.0 / (kSteps * kSteps);
            if (light.type == LightType::Sphere) {
                const double z = 2.0 * s - 1.0;
                const glm::dvec3 out = ring * std::sqrt(1.0 - z * z) + axis * z;
                add(radius * out, out, 4.0 * tessera::test::pi * radius * radius * piece);
            } else if (light.type == LightType::Rectangle) {
                const glm::dvec3 at = light.alongWS * ((s - 0.5) * double(light.widthMetres)) +
                                      glm::cross(axis, light.alongWS) * ((t - 0.5) * double(light.heightMetres));
                add(at, axis, largestSeenArea(light) * piece);
                add(at, -axis, largestSeenArea(light) * piece);
            } else {
                const double disk = tessera::test::pi * radius * radius * piece;
                const glm::dvec3 end = light.type == LightType::Tube ? axis * half : glm::dvec3(0.0);
                add(end + ring * (radius * std::sqrt(s)), axis, disk);
                add(-end + ring * (radius * std::sqrt(s)), -axis, disk);
                if (light.type == LightType::Tube)
                    add(axis * ((2.0 * s - 1.0) * half) + ring * radius, ring,
                        4.0 * tessera::test::pi * radius * half * piece);
            }
        }
    }
    return sum;
}

TEST(AreaLight, isNeverSeenLargerThanItsAreaFromTheBallItLiesIn) {
    tessera::test::Random random(5);
    for (const LightTypeInfo& info : lightTypes()) {
        if (!info.isArea) continue;
        for (int i = 0; i < 60; ++i) {
            Light light;
            light.type = info.type;
            light.directionWS = random.direction();
            light.alongWS = random.around(light.directionWS, 0.0, 0.0);
            for (float Light::*metres :
                 {&Light::widthMetres, &Light::heightMetres, &Light::lengthMetres, &Light::radiusMetres})
                light.*metres = float(random.logarithmic(0.05, 5.0));
            const double ball = surfaceReachMetres(light), away = ball * random.logarithmic(0.3, 30.0);
            const glm::dvec3 from = random.direction() * (ball + away);
            // Pieces of 1/3600 of the surface are off by a few per cent at most.
            EXPECT_LT(solidAngleFrom(light, from), 1.05 * largestSeenArea(light) / (away * away)) << info.name;
        }
    }
}

} // namespace
} // namespace tessera::scenes
