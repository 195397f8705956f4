// Irradiance of single lights at points: the product's packing and shader against the reference in double precision.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "renderer/frame/FeatureDefines.h"
#include "renderer/frame/LightBuffer.h"
#include "scenes/AreaLight.h"
#include "validation/reference/LightAt.h"
#include "validation/stress/StressCase.h"
#include "validation/stress/StressRandom.h"

namespace tessera::validation {

namespace {

using scenes::Falloff;
using scenes::Light;
using scenes::LightType;

/// A point and a light, by index.
struct Probe {
    glm::vec3 positionWS;
    std::size_t light;
};

constexpr double kLightTolerance = 3e-6;
constexpr const char* kLightReason =
    "some twenty roundings of 6e-8, of the light without its range: that subtracts "
    "from one; a cone counts with what it "
    "changes by when the directions it is computed from move by four roundings, and an "
    "area with the most that it shows, of which its angle leaves a share";

reference::Incident truthAt(const Light& light, const glm::dvec3& positionWS) {
    scenes::Scene scene;
    scene.lights = {light};
    const auto shining = reference::shiningLights(scene, {}, glm::dvec3(0.0));
    return shining.empty() ? reference::Incident{} : reference::incidentAt(shining.front(), positionWS);
}

/// The cone's factor, and its largest change when its inputs are off by four roundings of fp32. The inputs are the
/// angle at the light, whose ray is rounded by subtraction and normalisation and whose axis is rounded by packing, and
/// the distances of both cosines from 1 (for a wide cone, -1), relative to these distances.
struct Cone {
    double factor = 1.0;
    double condition = 0.0;
};

Cone coneOf(const Light& light, const glm::dvec3& positionWS) {
    if (scenes::infoOf(light.type).reach != scenes::LightReach::Cone) return {};
    constexpr double kRounding = 4.0 * 0x1p-24;
    const glm::dvec3 ray = glm::normalize(positionWS - light.positionWS);
    const double cosAngle = glm::dot(ray, light.directionWS),
                 sinAngle = glm::length(glm::cross(ray, light.directionWS));
    const double cosOuter = std::cos(double(light.outerConeRadians));
    const double scale = 1.0 / std::max(0.001, std::cos(double(light.innerConeRadians)) - cosOuter);
    const double side = cosOuter < 0.0 ? -1.0 : 1.0;
    const double distances = (1.0 - side * cosAngle) + (1.0 - side * cosOuter);
    const double move = kRounding * (sinAngle + 0.5 * kRounding + distances) * scale;
    const auto squared = [](double open) { return std::pow(std::clamp(open, 0.0, 1.0), 2); };
    const double open = (cosAngle - cosOuter) * scale;
    const double factor = squared(open);
    return {factor, std::max(squared(open + move) - factor, factor - squared(open - move))};
}

/// The error scale of an area light without range: its irradiance, and the change of that with the visible area P.
/// Rounding of P is relative to the largest P; the irradiance is P / (d^2 + P / pi), whose derivative is (1 -
/// irradiance / pi)^2 / d^2.
double scaleOfArea(Light light, const glm::dvec3& positionWS) {
    if (!scenes::hasSurface(light)) return 0.0;
    const double largest = scenes::largestSeenArea(light);
    light.rangeMetres = scenes::kInfinity;
    const double arriving = truthAt(light, positionWS).irradiance.x;
    const glm::dvec3 toLight = light.positionWS - positionWS;
    light.type = LightType::Directional;
    const double radiance = truthAt(light, positionWS).irradiance.x;
    if (radiance == 0.0) return 0.0;
    const double dark = 1.0 - arriving / (std::numbers::pi * radiance);
    return arriving + radiance * largest * dark * dark / glm::dot(toLight, toLight);
}

/// The scale of relative errors: the irradiance without range, times the sum of the cone's factor and its condition
/// over the tolerance. 0 where the irradiance is certainly 0.
double scaleOf(const Light& light, const glm::dvec3& positionWS) {
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    if (info.isArea) return scaleOfArea(light, positionWS);
    Light open = light;
    open.rangeMetres = scenes::kInfinity;
    if (info.hasPosition()) open.type = LightType::Point;
    const Cone cone = coneOf(light, positionWS);
    return (cone.factor + cone.condition / kLightTolerance) * truthAt(open, positionWS).irradiance.x;
}

std::string describe(const Light& light, const glm::vec3& positionWS) {
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    const std::string shape =
        info.isArea
            ? fmt::format("{:g} m by {:g} m, length {:g} m, radius {:g} m{}", light.widthMetres, light.heightMetres,
                          light.lengthMetres, light.radiusMetres, light.isTwoSided ? ", two-sided" : "")
            : fmt::format("cone {:g} to {:g}, A B C {:g} {:g} {:g}", light.innerConeRadians, light.outerConeRadians,
                          light.attenuation.x, light.attenuation.y, light.attenuation.z);
    return fmt::format("{}, intensity {:g}, range {:g}, {}, {:g} m away", info.name, light.intensity, light.rangeMetres,
                       shape, glm::length(light.positionWS - glm::dvec3(positionWS)));
}

void measure(StressBench& bench, const std::vector<Light>& lights, const std::vector<Probe>& probes,
             StressFigures& figures) {
    scenes::Scene scene;
    scene.lights = lights;
    frame::FrameSettings settings;
    settings.prune = false; // every light keeps its index
    // The eye is at the world origin, so that world and lighting space coincide.
    const frame::CameraView view =
        frame::makeCameraView(scenes::Camera{}, {64, 64}, frame::LightingSpace::World, glm::vec3(0.0f));
    const frame::LightBuffer buffer(frame::packLights(scene, view, settings), frame::allFeatures());
    buffer.bind();
    std::vector<glm::vec4> inputs;
    for (const Probe& probe : probes) inputs.emplace_back(probe.positionWS, float(probe.light));
    const std::vector<glm::vec4> out =
        bench.run("stress/incident.comp", frame::featureDefines(frame::allFeatures()), inputs, probes.size(), 2);
    for (std::size_t i = 0; i < probes.size(); ++i) {
        const Light& light = lights[probes[i].light];
        const glm::dvec3 positionWS(probes[i].positionWS);
        figures.count({&out[2 * i].x, 3});
        // Components of directions may be negative, so only NaN and infinity count.
        const glm::vec3 direction = glm::abs(glm::vec3(out[2 * i + 1]));
        StressFigures bad;
        bad.count({&direction.x, 3});
        figures.nan += bad.nan;
        figures.infinite += bad.infinite;
        // At the light's position there is no direction, and so no reflected light at any intensity.
        if (scenes::infoOf(light.type).hasPosition() && light.positionWS == positionWS) {
            ++figures.undecided;
            continue;
        }
        const reference::Incident truth = truthAt(light, positionWS);
        const double scale = std::max(scaleOf(light, positionWS), 1e-37); // near fp32's smallest normal number
        figures.error(std::abs(double(out[2 * i].x) - truth.irradiance.x) / scale,
                      [&] { return describe(light, probes[i].positionWS); });
    }
}

Light pointLight(float intensity, float rangeMetres = scenes::kInfinity) {
    Light light;
    light.intensity = intensity;
    light.rangeMetres = rangeMetres;
    return light;
}

/// The origin, and points in random directions at every power of ten from 1e-6 m to 1e6 m.
std::vector<glm::vec3> pointsAround(StressRandom& random, int perDecade) {
    std::vector<glm::vec3> points{glm::vec3(0.0f)};
    for (int decade = -6; decade <= 6; ++decade)
        for (int i = 0; i < perDecade; ++i)
            points.emplace_back(random.direction() * std::pow(10.0, double(decade)) * random.between(0.5, 1.0));
    return points;
}

void everyLightAtEveryPoint(StressBench& bench, const std::vector<Light>& lights, std::uint64_t seed,
                            StressFigures& figures) {
    StressRandom random(seed);
    const auto points = pointsAround(random, bench.effort() == StressEffort::Full ? 40 : 4);
    std::vector<Probe> probes;
    for (std::size_t light = 0; light < lights.size(); ++light)
        for (const glm::vec3& point : points) probes.push_back({point, light});
    measure(bench, lights, probes, figures);
}

void measureDistances(StressBench& bench, StressFigures& figures) {
    std::vector<Light> lights{pointLight(1.0f)};
    for (const glm::vec3& abc :
         {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(0.1f, 0.2f, 0.3f)}) {
        lights.push_back(pointLight(1.0f));
        lights.back().falloff = Falloff::Attenuation;
        lights.back().attenuation = abc;
    }
    everyLightAtEveryPoint(bench, lights, 11, figures);
}

void measureIntensities(StressBench& bench, StressFigures& figures) {
    std::vector<Light> lights;
    for (int exponent = -20; exponent <= 20; ++exponent) {
        for (const scenes::LightTypeInfo& type : scenes::lightTypes()) {
            lights.push_back(pointLight(float(std::pow(10.0, exponent))));
            lights.back().type = type.type;
            if (type.isArea) lights.back().radiusMetres = 0.5f;
        }
    }
    everyLightAtEveryPoint(bench, lights, 12, figures);
}

void measureRanges(StressBench& bench, StressFigures& figures) {
    std::vector<Light> lights;
    for (const float range : {0.0f, 1e-6f, 1e-3f, 1.0f, 10.0f, 1e3f, 1e6f, scenes::kInfinity})
        lights.push_back(pointLight(1.0f, range));
    everyLightAtEveryPoint(bench, lights, 13, figures);
}

/// A point inside or just outside the cone: 0 to 1.2 times the outer angle from the axis.
glm::vec3 pointAboutTheCone(StressRandom& random, const Light& light) {
    const double angle = std::min(std::numbers::pi, 1.2 * std::sqrt(random.unit()) * double(light.outerConeRadians));
    const glm::dvec3 across = random.around(light.directionWS, 0.0);
    const glm::dvec3 ray = light.directionWS * std::cos(angle) + across * std::sin(angle);
    return glm::vec3(light.positionWS + ray * random.logarithmic(1e-2, 1e3));
}

/// Narrow, wide, soft and hard cones in any direction, each probed inside and outside.
void measureCones(StressBench& bench, StressFigures& figures) {
    StressRandom random(14);
    constexpr double kDegree = std::numbers::pi / 180.0;
    const int turns = bench.effort() == StressEffort::Full ? 100 : 10;
    std::vector<Light> lights;
    std::vector<Probe> probes;
    for (const double outer : {0.0, 1e-4, 0.1 * kDegree, 0.5 * kDegree, kDegree, 5.0 * kDegree, 10.0 * kDegree, 0.5,
                               1.5, 1.6, 3.0, 179.9 * kDegree, std::numbers::pi}) {
        for (const double share : {0.0, 0.5, 0.99, 0.999, 1.0}) {
            for (int turn = 0; turn < turns; ++turn) {
                Light light = pointLight(1.0f);
                light.type = LightType::Spot;
                // Exact in fp32, so that both sides use the same position.
                if (turn % 2 == 1) light.positionWS = glm::dvec3(glm::vec3(random.direction()));
                light.directionWS = turn == 0 ? glm::dvec3(0.0, 0.0, -1.0) : random.direction();
                light.outerConeRadians = std::min(float(outer), std::numbers::pi_v<float>);
                light.innerConeRadians = float(share) * light.outerConeRadians;
                for (int i = 0; i < 32; ++i) probes.push_back({pointAboutTheCone(random, light), lights.size()});
                lights.push_back(light);
            }
        }
    }
    measure(bench, lights, probes, figures);
}

/// A surface with random orientation and dimensions from 1 mm to 1 km.
void drawSurface(StressRandom& random, Light& light) {
    for (float* metres : {&light.widthMetres, &light.heightMetres, &light.lengthMetres, &light.radiusMetres})
        *metres = float(random.logarithmic(1e-3, 1e3));
    light.corners.count = 0;
    // Corners sorted by angle form an outline at any distances.
    const double around = 2.0 * std::numbers::pi / double(3 + random.index(6));
    for (double angle = 0.0; angle < 2.0 * std::numbers::pi - 0.5 * around; angle += around) {
        const double metres = double(light.widthMetres) * random.between(0.1, 1.0);
        light.corners.add(glm::vec2(metres * glm::dvec2(std::cos(angle), std::sin(angle))));
    }
    light.alongWS = random.around(light.directionWS, 0.0);
    light.isTwoSided = random.index(2) == 0;
    light.falloff = Falloff::InverseSquare;
}

/// Draws the parameters of the light's type within their bounds, except the cone's angles.
void drawOtherParameters(StressRandom& random, Light& light) {
    for (const scenes::LightParameter& parameter : scenes::infoOf(light.type).parameters) {
        if (parameter.member == &Light::innerConeRadians || parameter.member == &Light::outerConeRadians) continue;
        const auto value = float(random.between(double(parameter.least), double(parameter.most)));
        light.*parameter.member = parameter.kind == scenes::LightParameter::Kind::Angle ? glm::radians(value) : value;
    }
}

void measureRandomLights(StressBench& bench, StressFigures& figures) {
    StressRandom random(15);
    std::vector<Light> lights;
    std::vector<Probe> probes;
    const std::size_t count = bench.effort() == StressEffort::Full ? 200000 : 20000;
    for (std::size_t i = 0; i < count; ++i) {
        Light light = pointLight(float(random.logarithmic(1e-20, 1e20)));
        light.type = LightType(random.index(int(scenes::kLightTypeCount)));
        light.falloff = Falloff(random.index(2));
        // Exact in fp32, so that both sides use the same position.
        light.positionWS = glm::dvec3(glm::vec3(random.direction() * random.logarithmic(1e-3, 1e3)));
        light.directionWS = random.direction();
        if (random.index(2) == 0) light.rangeMetres = float(random.logarithmic(1e-2, 1e4));
        light.attenuation = random.color() + glm::vec3(1e-3f);
        light.outerConeRadians = float(random.between(0.0, std::numbers::pi_v<float>));
        light.innerConeRadians = float(random.unit()) * light.outerConeRadians;
        if (scenes::infoOf(light.type).isArea)
            drawSurface(random, light);
        else
            drawOtherParameters(random, light);
        lights.push_back(light);
        probes.push_back({glm::vec3(random.direction() * random.logarithmic(1e-3, 1e3)), i});
    }
    measure(bench, lights, probes, figures);
}

} // namespace

void addLightCases(std::vector<StressCase>& cases) {
    const auto add = [&cases](const char* name, const char* holds, void (*run)(StressBench&, StressFigures&)) {
        cases.push_back({name, holds, StressBound::WorstRel, kLightTolerance, kLightReason, run});
    };
    add("light/distance", "a light at d = 0, and from 1e-6 m to 1e6 m away, with each falloff", measureDistances);
    add("light/intensity", "intensities from 1e-20 to 1e20 of every kind of light", measureIntensities);
    add("light/range", "ranges of 0, 1e-6 m to 1e6 m and without end", measureRanges);
    add("light/cone", "cones of 0 to 180 degrees, from soft to sharp, from within and from just outside", measureCones);
    add("light/random", "random lights of every kind", measureRandomLights);
}

} // namespace tessera::validation
