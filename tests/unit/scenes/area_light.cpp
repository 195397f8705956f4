#include "scenes/AreaLight.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "scenes/Shadows.h"
#include "tests/support/AreaLights.h"
#include "tests/support/Random.h"

namespace tessera::scenes {
namespace {

using tessera::test::cornersOf;

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
    light.type = LightType::Polygon;
    EXPECT_TRUE(hasSurface(light));
    for (const float metres : {0.9e-6f, 1.01e-6f}) {
        light.corners = cornersOf({{0.0f, 0.0f}, {metres, 0.0f}, {metres, metres}, {0.0f, metres}});
        EXPECT_EQ(hasSurface(light), metres > 1e-6f);
    }
}

TEST(LightCorners, haveTheAreaAndTheMiddleOfTheirOutline) {
    // An L of two bars: 2 x 1 m, and 1 x 2 m on top of its left half.
    const LightCorners ell = cornersOf({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 3}, {0, 3}});
    EXPECT_DOUBLE_EQ(signedArea(ell), 4.0);
    EXPECT_LT(glm::distance(middleOf(ell), 0.5 * (glm::dvec2(1.0, 0.5) + glm::dvec2(0.5, 2.0))), 1e-15);
    LightCorners other = ell;
    std::reverse(other.metres.begin(), other.metres.begin() + 6);
    EXPECT_DOUBLE_EQ(signedArea(other), -4.0);
    EXPECT_LT(glm::distance(middleOf(other), middleOf(ell)), 1e-15);
    for (std::size_t i = 0; i < other.count; ++i) other.metres[i] += glm::vec2(100.0f, -50.0f);
    EXPECT_DOUBLE_EQ(signedArea(other), -4.0);
    EXPECT_LT(glm::distance(middleOf(other), middleOf(ell) + glm::dvec2(100.0, -50.0)), 1e-12);
}

TEST(LightCorners, areCoveredOnceByTheirTriangles) {
    tessera::test::Random random(6);
    for (const LightCorners& corners :
         {cornersOf({{0, 0}, {1, 0}, {0, 1}}), cornersOf({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}),
          cornersOf({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 0.25f}, {0, 1}}), // one on a straight edge
          cornersOf({{0, 3}, {1, 3}, {1, 1}, {2, 1}, {2, 3}, {3, 3}, {3, 0}, {0, 0}})}) {
        const auto triangles = trianglesOf(corners);
        EXPECT_EQ(triangles.size(), corners.count - 2);
        const auto holds = [](const LightCorners& outline, const glm::dvec2& place) {
            bool isWithin = false;
            for (std::size_t i = 0; i < outline.count; ++i) {
                const glm::dvec2 a(outline.metres[i]), b(outline.metres[(i + 1) % outline.count]);
                if ((a.y > place.y) != (b.y > place.y) && place.x < a.x + (b.x - a.x) * (place.y - a.y) / (b.y - a.y))
                    isWithin = !isWithin;
            }
            return isWithin;
        };
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec2 place(random.between(-0.5, 3.5), random.between(-0.5, 3.5));
            const auto covering = std::ranges::count_if(triangles, [&](const std::array<std::uint8_t, 3>& triangle) {
                return holds(
                    cornersOf({corners.metres[triangle[0]], corners.metres[triangle[1]], corners.metres[triangle[2]]}),
                    place);
            });
            ASSERT_EQ(covering, holds(corners, place) ? 1 : 0) << place.x << ", " << place.y;
        }
    }
}

TEST(LightCorners, whatIsNoOutlineIsNamed) {
    for (const auto& [corners, problem] : {
             std::pair{cornersOf({{0, 0}, {1, 0}, {0, 1}}), ""},
             {cornersOf({{0, 0}, {0, 1}, {1, 0}}), ""},            // the other way round
             {cornersOf({{0, 0}, {1, 0}, {2, 0}, {0, 1}}), ""},    // one on a straight edge
             {cornersOf({{0, 0}, {2, 0}, {2, 2}, {1, 0.5f}}), ""}, // a reflex corner
             {cornersOf({{0, 0}, {1, 0}}), "number 2; 3 to 8 are needed"},
             {cornersOf({{0, 0}, {2e6f, 0}, {0, 1}}),
              "have number 1 at (2e+06, 0); both must lie between -1e+06 and 1e+06 m"},
             {cornersOf({{0, 0}, {1, 0}, {0, 1}, {1, 0}}), "1 and 3 lie in one place; keep one"},
             {cornersOf({{0, 0}, {2, 0}, {1, 0}}), "fold back at number 1; no area lies between the two edges"},
             {cornersOf({{0, 0}, {1, 1}, {1, 0}, {0, 1}}),
              "let the edge from number 0 to 1 meet that from number 2 to 3; move one of them"},
             {cornersOf({{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}}),
              "let the edge from number 0 to 1 meet that from number 2 to 3; move one of them"},
             {cornersOf({{0, 0}, {4, 0}, {4, 1}, {3, 1}, {1, 0}, {0, 1}}),
              "let the edge from number 0 to 1 meet that from number 3 to 4; move one of them"},
         })
        EXPECT_EQ(cornersProblem(corners), problem);
    LightCorners broken;
    broken.metres[2].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(cornersProblem(broken), "have number 2 at (0.5, nan); both must lie between -1e+06 and 1e+06 m");
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

/// Solid angle of the surface parts that face a point, summed over small pieces.
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
            } else if (light.type == LightType::Polygon) { // two triangles from its first corner
                const std::span<const glm::vec2> corners = light.corners.all();
                for (const std::size_t k : {1u, 2u}) {
                    const glm::dvec2 first(corners[0]), a = glm::dvec2(corners[k]) - first,
                                                        b = glm::dvec2(corners[k + 1]) - first;
                    const glm::dvec2 place = first + std::sqrt(s) * glm::mix(a, b, t);
                    const glm::dvec3 at = place.x * light.alongWS + place.y * glm::cross(axis, light.alongWS);
                    const double area = 0.5 * std::abs(a.x * b.y - a.y * b.x) * piece;
                    add(at, axis, area);
                    add(at, -axis, area);
                }
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
            const float size = light.widthMetres;
            light.corners =
                cornersOf({{-0.2f * size, 0.1f * size}, {size, 0}, {0.1f * size, size}, {-0.6f * size, size}});
            const double ball = surfaceReachMetres(light), away = ball * random.logarithmic(0.3, 30.0);
            const glm::dvec3 from = random.direction() * (ball + away);
            // Pieces of 1/3600 of the surface are off by a few per cent at most.
            EXPECT_LT(solidAngleFrom(light, from), 1.05 * largestSeenArea(light) / (away * away)) << info.name;
        }
    }
}

} // namespace
} // namespace tessera::scenes
