// Irradiance from lights: the product's packed lights, read by the product's shader, compared with the formulas in
// double.
#include <gtest/gtest.h>

#include "renderer/frame/FeatureDefines.h"
#include "renderer/frame/LightBuffer.h"
#include "tests/gpu/shaders/ShaderBench.h"
#include "tests/support/Random.h"

namespace tessera {
namespace {

using scenes::Falloff;
using scenes::Light;
using scenes::LightType;

struct Arrival {
    glm::vec3 irradiance;
    glm::vec3 toLight;
    bool reaches;
};
struct Probe {
    glm::vec3 position;
    int light;
};

class IncidentTest : public test::GlTest {
protected:
    /// The eye is the world's origin and looks along -z, so world and lighting space coincide.
    std::vector<Arrival> run(const std::vector<Light>& sceneLights, const std::vector<Probe>& probes,
                             double rangeTolerance = 0.0) {
        scenes::Scene scene;
        scene.lights = sceneLights;
        frame::FrameSettings settings;
        settings.prune = false;
        settings.rangeTolerance = rangeTolerance;
        const frame::CameraView view =
            frame::makeCameraView(scenes::Camera{}, {64, 64}, frame::LightingSpace::World, glm::vec3(0.0f));
        const frame::PackedLights packed = frame::packLights(scene, view, settings);
        const frame::LightBuffer lightBuffer(packed, frame::allFeatures());
        lightBuffer.bind();
        std::vector<glm::vec4> inputs;
        for (const Probe& probe : probes) inputs.emplace_back(probe.position, float(probe.light));
        const std::vector<glm::vec4> out =
            bench.run("stress/incident.comp", frame::featureDefines(frame::allFeatures()), inputs, probes.size(), 2);
        std::vector<Arrival> arrivals;
        for (std::size_t i = 0; i < probes.size(); ++i)
            arrivals.push_back({glm::vec3(out[2 * i]), glm::vec3(out[2 * i + 1]), out[2 * i].w != 0.0f});
        return arrivals;
    }
    test::ShaderBench bench;
};

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// shading.md section 2, with the scene's values.
double expectedIrradiance(const Light& light, const glm::dvec3& position) {
    if (light.type == LightType::Directional) return light.intensity;
    const glm::dvec3 toLight = light.positionWS - position;
    const double d = glm::length(toLight);
    double falloff = 0.0;
    if (light.falloff == Falloff::InverseSquare) {
        const double window = std::clamp(1.0 - std::pow(d / double(light.rangeMetres), 4.0), 0.0, 1.0);
        falloff = window * window / std::max(d * d, 1e-4);
    } else {
        const glm::dvec3 abc(light.attenuation);
        falloff = 1.0 / std::max(abc.x + abc.y * d + abc.z * d * d, 1e-4);
    }
    double cone = 1.0;
    if (light.type == LightType::Spot) {
        const double outer = std::cos(double(light.outerConeRadians)), inner = std::cos(double(light.innerConeRadians));
        const double angle = glm::dot(-toLight / d, light.directionWS);
        cone = std::clamp((angle - outer) / std::max(0.001, inner - outer), 0.0, 1.0);
        if (!(light.outerConeRadians > 0.0f)) cone = 0.0;
    }
    return double(light.intensity) * falloff * cone * cone;
}

/// Tolerance of expectedIrradiance(): 3e-6, twenty roundings, of the light without its range window, which subtracts
/// from one; and the change of its cone if the angle at the light is off by four roundings of fp32 (the ray to the
/// light is rounded twice, the packed axis once, each in three components), and the distances of the two cosines from
/// 1, or of a wide cone from -1, by four as well.
double allowedError(Light light, const glm::dvec3& position) {
    light.rangeMetres = scenes::kInfinity;
    const double windowed = expectedIrradiance(light, position);
    if (light.type != LightType::Spot) return 3e-6 * windowed;
    const glm::dvec3 ray = glm::normalize(position - light.positionWS);
    const double outer = double(light.outerConeRadians), side = std::cos(outer) < 0.0 ? -1.0 : 1.0;
    const double cosine = glm::dot(ray, light.directionWS), sine = glm::length(glm::cross(ray, light.directionWS));
    const double scale = 1.0 / std::max(0.001, std::cos(double(light.innerConeRadians)) - std::cos(outer));
    constexpr double kFour = 4.0 * 0x1p-24;
    const double moved = kFour * (sine + 0.5 * kFour + (1.0 - side * cosine) + (1.0 - side * std::cos(outer))) * scale;
    const double cone = (cosine - std::cos(outer)) * scale;
    const double low = std::clamp(cone - moved, 0.0, 1.0), high = std::clamp(cone + moved, 0.0, 1.0);
    light.type = LightType::Point;
    return 3e-6 * windowed + (high * high - low * low) * expectedIrradiance(light, position);
}

Light randomLight(test::Random& random) {
    Light light;
    light.type = std::array{LightType::Directional, LightType::Point, LightType::Spot}[std::size_t(random.index(3))];
    light.falloff = random.index(2) == 0 ? Falloff::InverseSquare : Falloff::Attenuation;
    light.intensity = float(random.logarithmic(0.01, 100.0));
    // Exact in fp32, so that the packed position equals the scene's.
    light.positionWS = glm::dvec3(glm::vec3(random.direction() * 10.0));
    light.directionWS = random.direction();
    light.rangeMetres = random.index(3) == 0 ? scenes::kInfinity : float(random.between(5.0, 30.0));
    light.attenuation = {random.unit(), random.unit(), random.unit()};
    light.outerConeRadians = float(random.between(0.1, 3.1));
    light.innerConeRadians = float(random.unit() * light.outerConeRadians);
    return light;
}

TEST_F(IncidentTest, theIrradianceOfEveryKindOfLightFollowsItsFormula) {
    test::Random random(8);
    std::vector<Light> lights;
    std::vector<Probe> probes;
    for (int i = 0; i < 20000; ++i) {
        lights.push_back(randomLight(random));
        probes.push_back({glm::vec3(random.direction() * random.between(0.0, 20.0)), i});
    }
    const std::vector<Arrival> arrivals = run(lights, probes);
    int reached = 0;
    for (std::size_t i = 0; i < probes.size(); ++i) {
        const glm::dvec3 position(probes[i].position);
        ASSERT_NEAR(double(arrivals[i].irradiance.x), expectedIrradiance(lights[i], position),
                    allowedError(lights[i], position))
            << "light " << i;
        if (!arrivals[i].reaches) continue;
        ++reached;
        const glm::dvec3 direction = lights[i].type == LightType::Directional
                                         ? -lights[i].directionWS
                                         : glm::normalize(lights[i].positionWS - glm::dvec3(probes[i].position));
        ASSERT_LE(glm::length(glm::dvec3(arrivals[i].toLight) - direction), 5e-7) << "light " << i; // a few ulp of one
    }
    EXPECT_GT(reached, 5000);
}

/// Cones in random directions, with probes from their axes to just outside.
TEST_F(IncidentTest, aConeHoweverNarrowWideOrHardKeepsItsDigits) {
    test::Random random(12);
    std::vector<Light> lights;
    std::vector<Probe> probes;
    constexpr double kDegree = test::pi / 180.0;
    constexpr std::pair<double, double> kInnerOuter[] = {{0.0, 0.1},   {0.0, 0.5},   {0.9, 1.0},     {0.0, 1.0},
                                                         {2.0, 5.0},   {9.9, 10.0},  {0.0, 45.0},    {89.0, 89.9},
                                                         {89.0, 90.1}, {0.0, 135.0}, {178.0, 179.0}, {179.9, 179.9}};
    for (const auto& [inner, outer] : kInnerOuter) {
        for (int i = 0; i < 2000; ++i) {
            Light light;
            light.type = LightType::Spot;
            light.positionWS = glm::dvec3(glm::vec3(random.direction())); // exact in fp32
            light.directionWS = random.direction();
            light.innerConeRadians = float(inner * kDegree);
            light.outerConeRadians = float(outer * kDegree);
            const double angle = std::min(test::pi, 1.1 * std::sqrt(random.unit()) * outer * kDegree);
            const glm::dvec3 ray = random.around(light.directionWS, std::cos(angle), std::cos(angle));
            probes.push_back({glm::vec3(light.positionWS + ray * random.between(0.5, 20.0)), int(lights.size())});
            lights.push_back(light);
        }
    }
    const std::vector<Arrival> arrivals = run(lights, probes);
    int lit = 0, dark = 0;
    for (std::size_t i = 0; i < probes.size(); ++i) {
        const glm::dvec3 position(probes[i].position);
        ASSERT_NEAR(double(arrivals[i].irradiance.x), expectedIrradiance(lights[i], position),
                    allowedError(lights[i], position))
            << "cone of " << lights[i].innerConeRadians / kDegree << " to " << lights[i].outerConeRadians / kDegree;
        (arrivals[i].reaches ? lit : dark) += 1;
    }
    EXPECT_GT(lit, 12000);
    EXPECT_GT(dark, 2000);
}

TEST_F(IncidentTest, atItsRangeAndBeyondALightIsExactlyZero) {
    test::Random random(9);
    std::vector<Light> lights;
    std::vector<Probe> probes;
    for (int i = 0; i < 20000; ++i) {
        Light light;
        light.type = i % 2 == 0 ? LightType::Point : LightType::Spot;
        light.outerConeRadians = 3.0f;
        light.intensity = 1e20f;
        light.rangeMetres = float(random.logarithmic(1e-3, 1e4));
        lights.push_back(light);
        const int axis = random.index(3);
        glm::vec3 position(0.0f);
        position[axis] = light.rangeMetres; // along an axis the distance is the range to the last bit
        if (i % 3 == 1) position[axis] = -std::nextafter(light.rangeMetres, scenes::kInfinity);
        if (i % 3 == 2) {
            // Any direction, at a distance that fp32 rounds to at least the range.
            position = glm::vec3(random.direction() * (double(light.rangeMetres) * (1.0 + 2e-7)));
        }
        probes.push_back({position, i});
    }
    const std::vector<Arrival> arrivals = run(lights, probes);
    for (std::size_t i = 0; i < probes.size(); ++i)
        ASSERT_EQ(arrivals[i].irradiance, glm::vec3(0.0f)) << "range " << lights[i].rangeMetres << " probe " << i;
}

TEST_F(IncidentTest, aLightThatAToleranceEndsIsExactlyZeroAtItsReachAndBeyond) {
    constexpr double kTolerance = 0.01;
    test::Random random(11);
    std::vector<Light> lights;
    std::vector<Probe> probes;
    for (int i = 0; i < 20000; ++i) {
        Light light;
        light.type = i % 2 == 0 ? LightType::Point : LightType::Spot;
        light.outerConeRadians = 3.0f;
        light.falloff = Falloff::Attenuation;
        light.intensity = float(random.logarithmic(0.1, 1e6));
        light.attenuation = {random.index(2) * random.unit(), random.unit(), random.index(2) * random.unit()};
        lights.push_back(light);
        const double reach = frame::reachMetres(light, kTolerance);
        float place = float(reach);
        if (place < reach) place = std::nextafter(place, scenes::kInfinity);
        if (i % 2 == 1) place = std::nextafter(place, scenes::kInfinity);
        glm::vec3 position(0.0f);
        position[random.index(3)] = i % 4 < 2 ? place : -place;
        // Any direction, at a distance that fp32 rounds to at least the radius; or well inside, where light arrives.
        if (i % 3 == 1) position = glm::vec3(random.direction() * (reach * (1.0 + 2e-7)));
        if (i % 3 == 2) position = glm::vec3(random.around({0, 0, -1}, 0.0, 1.0) * (reach * random.between(0.1, 0.9)));
        probes.push_back({position, i});
    }
    const std::vector<Arrival> arrivals = run(lights, probes, kTolerance);
    for (std::size_t i = 0; i < probes.size(); ++i)
        ASSERT_EQ(arrivals[i].irradiance.x > 0.0f, i % 3 == 2)
            << "reach " << frame::reachMetres(lights[i], kTolerance) << " probe " << i;
}

TEST_F(IncidentTest, extremeLightsNeverSendNaNInfiniteOrNegativeLight) {
    std::vector<Light> lights;
    for (const LightType type : {LightType::Directional, LightType::Point, LightType::Spot})
        for (const Falloff falloff : {Falloff::InverseSquare, Falloff::Attenuation})
            for (const float intensity : {0.0f, 1e-20f, 1.0f, 1e20f})
                for (const float range : {0.0f, 1e-30f, 1e-6f, 1.0f, 1e6f, 1e30f, scenes::kInfinity})
                    for (const float outer : {0.0f, 1e-4f, 1.0f, 3.14159265f})
                        for (const glm::vec3 abc :
                             {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(1e-30f, 0, 0),
                              glm::vec3(1e30f), glm::vec3(0, 0, 1e-38f)}) {
                            Light light;
                            light.type = type;
                            light.falloff = falloff;
                            light.intensity = intensity;
                            light.rangeMetres = range;
                            light.outerConeRadians = outer;
                            light.innerConeRadians = 0.5f * outer;
                            light.attenuation = abc;
                            lights.push_back(light);
                        }
    const std::vector<glm::vec3> positions{{0, 0, 0},      {1e-6f, 0, 0}, {0, 0, -1e-6f},   {1, 1, -1},
                                           {0, 0, -1},     {0, 0, 1},     {1e6f, 0, 0},     {0, 0, -1e6f},
                                           {1e-30f, 0, 0}, {1e19f, 0, 0}, {0, 1e30f, 1e30f}};
    std::vector<Probe> probes;
    for (std::size_t i = 0; i < lights.size(); ++i)
        for (const glm::vec3& position : positions) probes.push_back({position, int(i)});
    const std::vector<Arrival> arrivals = run(lights, probes);
    for (std::size_t i = 0; i < probes.size(); ++i) {
        const Arrival& a = arrivals[i];
        const Light& light = lights[std::size_t(probes[i].light)];
        ASSERT_TRUE(isFinite(a.irradiance) && isFinite(a.toLight) && a.irradiance.x >= 0.0f) << "probe " << i;
        const bool windowed = light.type != LightType::Directional && light.falloff == Falloff::InverseSquare;
        const bool dark = light.intensity == 0.0f || (windowed && light.rangeMetres == 0.0f) ||
                          (light.type == LightType::Spot && light.outerConeRadians == 0.0f);
        if (dark) {
            ASSERT_EQ(a.irradiance.x, 0.0f) << "probe " << i;
        }
    }
}

TEST_F(IncidentTest, aSpotOfHalfAnAngleOfPiNeverLeavesADirectionDarkButItsOwnBack) {
    Light spot;
    spot.type = LightType::Spot;
    spot.innerConeRadians = 3.1f;
    spot.outerConeRadians = 3.14159265f;
    std::vector<Probe> probes;
    test::Random random(10);
    for (int i = 0; i < 1000; ++i) probes.push_back({glm::vec3(random.around({0, 0, -1}, -0.99, 1.0)), 0});
    for (const Arrival& a : run({spot}, probes)) ASSERT_GT(a.irradiance.x, 0.0f);
}

} // namespace
} // namespace tessera
