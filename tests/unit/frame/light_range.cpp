#include "renderer/frame/LightRange.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/Random.h"

namespace tessera::frame {
namespace {

using scenes::Falloff;
using scenes::Light;
using scenes::LightType;

Light attenuated(float intensity, const glm::vec3& abc) {
    Light light;
    light.falloff = Falloff::Attenuation;
    light.intensity = intensity;
    light.attenuation = abc;
    return light;
}

/// The largest channel of colour x intensity.
long double brightest(const Light& light) {
    return static_cast<long double>(std::max({light.color.r, light.color.g, light.color.b})) * light.intensity;
}

/// Returns whether the light exceeds the tolerance at r metres, by its definition.
bool isAbove(const Light& light, long double r, long double tolerance) {
    const glm::vec3& abc = light.attenuation;
    return brightest(light) - tolerance * abc.x > tolerance * (abc.y * r + abc.z * r * r);
}

/// The distance at which the light falls to the tolerance, by bisection to the precision of long double.
long double bisectedReach(const Light& light, long double tolerance) {
    if (!isAbove(light, 0.0L, tolerance)) return 0.0L;
    long double low = 1.0L;
    while (!isAbove(light, low, tolerance)) low /= 2.0L;
    while (isAbove(light, 2.0L * low, tolerance)) low *= 2.0L;
    long double high = 2.0L * low;
    for (;;) {
        const long double middle = low + (high - low) / 2.0L;
        if (middle <= low || middle >= high) return low;
        (isAbove(light, middle, tolerance) ? low : high) = middle;
    }
}

struct Case {
    Light light;
    double tolerance;
};

/// Some coefficients are 0, huge or tiny; some lights barely exceed the tolerance anywhere.
std::vector<Case> randomCases() {
    test::Random random(12);
    const auto coefficient = [&] {
        const int kind = random.index(4);
        if (kind == 0) return 0.0f;
        return float(kind == 1 ? random.logarithmic(1e-30, 1e30) : random.logarithmic(1e-3, 1e3));
    };
    std::vector<Case> cases;
    while (cases.size() < 20000) {
        Light light = attenuated(float(random.logarithmic(1e-3, 1e3)), {coefficient(), coefficient(), coefficient()});
        if (random.index(4) == 0) light.intensity = float(random.logarithmic(1e-20, 1e20));
        light.color = {random.unit(), random.unit(), random.unit()};
        if (light.attenuation.y == 0.0f && light.attenuation.z == 0.0f) continue;
        double tolerance = random.logarithmic(1e-10, 10.0);
        if (random.index(4) == 0) tolerance = random.logarithmic(1e-30, 1e10);
        // At distance 0 the light, divided by A, exceeds the tolerance by 1e-6 to 1 of it.
        const double atLight = double(brightest(light)) / light.attenuation.x;
        if (random.index(4) == 0 && std::isfinite(atLight)) tolerance = atLight / (1.0 + random.logarithmic(1e-6, 1.0));
        cases.push_back({light, tolerance});
    }
    return cases;
}

TEST(LightReach, agreesWithABisectionInExtendedPrecision) {
    std::size_t finite = 0, dark = 0;
    for (const auto& [light, tolerance] : randomCases()) {
        const long double expected = bisectedReach(light, tolerance);
        const double reach = reachMetres(light, tolerance);
        ++(expected > 0.0L ? finite : dark);
        // The root takes about ten roundings of 2^-53. Where the light at distance 0 exceeds the tolerance by only
        // 1e-6, the bisection's 2^-64 is amplified to 5e-14.
        ASSERT_NEAR(double(reach / (expected > 0.0L ? expected : 1.0L)), expected > 0.0L ? 1.0 : 0.0, 1e-12)
            << light.intensity << " A " << light.attenuation.x << " B " << light.attenuation.y << " C "
            << light.attenuation.z << " tolerance " << tolerance;
    }
    EXPECT_GT(finite, 5000u);
    EXPECT_GT(dark, 1000u);
}

TEST(LightReach, thereTheBrightestChannelIsTheTolerance) {
    for (const auto& [light, tolerance] : randomCases()) {
        const long double reach = reachMetres(light, tolerance);
        if (reach == 0.0L) continue;
        const glm::vec3& abc = light.attenuation;
        const long double there = brightest(light) / (abc.x + abc.y * reach + abc.z * reach * reach);
        ASSERT_NEAR(double(there / tolerance), 1.0, 1e-12); // ten roundings of 2^-53, doubled by C's square
    }
}

TEST(LightReach, isZeroExactlyWhenTheLightIsNowhereAboveTheTolerance) {
    const Light light = attenuated(3.0f, {6.0f, 0.25f, 0.5f}); // 1/2 at distance 0
    EXPECT_EQ(reachMetres(light, 0.5), 0.0);
    EXPECT_EQ(reachMetres(light, 0.75), 0.0);
    EXPECT_EQ(reachMetres(light, std::numeric_limits<double>::max()), 0.0);
    EXPECT_GT(reachMetres(light, std::nextafter(0.5, 0.0)), 0.0);
    EXPECT_EQ(reachMetres(attenuated(0.0f, {0.0f, 1.0f, 1.0f}), 1e-9), 0.0);
    for (const auto& [random, tolerance] : randomCases())
        EXPECT_EQ(reachMetres(random, tolerance) == 0.0, !isAbove(random, 0.0L, tolerance));
}

TEST(LightReach, isInfiniteWithoutAToleranceOrWithoutFalloff) {
    EXPECT_EQ(reachMetres(attenuated(1.0f, {1.0f, 2.0f, 3.0f}), 0.0), scenes::kInfinity);
    for (const double tolerance : {1e-300, 0.5, 1e300}) // even if all of it is below the tolerance
        EXPECT_EQ(reachMetres(attenuated(1.0f, {2.0f, 0.0f, 0.0f}), tolerance), scenes::kInfinity) << tolerance;
    EXPECT_EQ(reachMetres(attenuated(1e20f, {0.0f, 0.0f, 1e-38f}), std::numeric_limits<double>::denorm_min()),
              scenes::kInfinity)
        << "brightest / tolerance leaves double";
}

TEST(LightReach, aToleranceNeverTouchesALightOfAnotherFalloff) {
    Light light;
    light.attenuation = {1.0f, 1.0f, 1.0f};
    EXPECT_EQ(reachMetres(light, 0.1), scenes::kInfinity);
    light.rangeMetres = 7.0f;
    EXPECT_EQ(reachMetres(light, 0.1), 7.0);
    light.rangeMetres = 0.0f;
    EXPECT_EQ(reachMetres(light, 0.1), 0.0);
    light.falloff = Falloff::Attenuation;
    light.type = LightType::Directional;
    EXPECT_EQ(reachMetres(light, 0.1), scenes::kInfinity);
}

} // namespace
} // namespace tessera::frame
