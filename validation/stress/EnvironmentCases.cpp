// Environment light from degenerate maps: one texel, one row, black, all light in one texel, and any magnitude.
#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include <fmt/format.h>

#include "engine/Renderer.h"
#include "scenes/builtin/Pictures.h"
#include "validation/stress/StressCase.h"
#include "validation/stress/StressScene.h"

namespace tessera::validation {

namespace {

using frame::EnvironmentLight;

/// Small, so that filtering takes no time.
constexpr int kMapWidth = 32, kMapHeight = 16;

scenes::Environment mapOf(int width, int height, const std::function<glm::dvec3(int, int)>& radiance) {
    return {"stress", scenes::builtin::drawRadiance("stress", width, height, radiance)};
}

frame::FrameSettings surroundedSettings(EnvironmentLight light) {
    frame::FrameSettings settings;
    settings.sizePixels = {48, 32};
    settings.display = false;
    settings.environment.light = light;
    settings.environment.samples = 4;
    return settings;
}

scenes::Scene surrounded(scenes::Environment environment) {
    scenes::Scene scene = stressScene();
    scene.lights.clear();
    scene.environment = std::move(environment);
    return scene;
}

std::vector<StressPicture> evenMaps(StressEffort) {
    std::vector<StressPicture> pictures;
    const auto add = [&](std::string what, int width, int height, float rotationDegrees) {
        scenes::Environment environment = mapOf(width, height, [](int, int) { return glm::dvec3(0.5, 1.0, 2.0); });
        environment.rotationDegrees = rotationDegrees;
        StressPicture picture{std::move(what), surrounded(std::move(environment)),
                              surroundedSettings(EnvironmentLight::SplitSum)};
        constexpr double kNoise = 30.0; // for noise of the reference's samples, and for lobes with two alphas
        if (pictures.empty())
            picture.allowed = kNoise;
        else
            picture.sameAs = 0;
        pictures.push_back(std::move(picture));
    };
    add("32 x 16 texels", kMapWidth, kMapHeight, 0.0f);
    add("one texel", 1, 1, 0.0f);
    add("one row", 7, 1, 0.0f);
    add("one column", 1, 5, 0.0f);
    add("a thousand columns", 1000, 3, 0.0f);
    add("turned by 1e9 degrees", kMapWidth, kMapHeight, 1e9f);
    return pictures;
}

/// Multiplies maps by factors: images must change by the same factors.
void measureRadiance(StressBench& bench, StressFigures& figures) {
    const std::pair<const char*, std::function<glm::dvec3(int, int)>> maps[] = {
        {"a bright texel", [](int x, int y) { return glm::dvec3(x == 9 && y == 5 ? 1000.0 : 0.0); }},
        {"a half", [](int, int y) { return glm::dvec3(y < kMapHeight / 2 ? 1.0 : 0.0); }},
        {"noise", [](int x, int y) { return glm::dvec3((x * 7919 + y * 104729) % 1009, 1.0, x) / 100.0; }},
        {"black", [](int, int) { return glm::dvec3(0.0); }}};
    // Multiplying by a power of 2 is exact.
    const int exponents[] = {0, -60, -20, 20, 60};
    std::size_t done = 0;
    for (const EnvironmentLight light : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled}) {
        scenes::Scene scene = surrounded(mapOf(1, 1, [](int, int) { return glm::dvec3(1.0); }));
        engine::Renderer renderer(bench.context(), scene, bench.shaders());
        for (const auto& map : maps) {
            const char* const name = map.first;
            const auto& radiance = map.second;
            std::vector<float> plain;
            for (const int exponent : exponents) {
                const double factor = std::ldexp(1.0, exponent);
                scene.environment = mapOf(kMapWidth, kMapHeight, [&](int x, int y) { return factor * radiance(x, y); });
                renderer.environmentChanged();
                const std::vector<float> seen =
                    renderer.render(engine::Technique::Deferred, surroundedSettings(light)).radiance;
                if (plain.empty()) plain = seen;
                for (std::size_t i = 0; i < seen.size(); i += 4) {
                    figures.count(std::span(&seen[i], 3));
                    for (std::size_t c = i; c < i + 3; ++c) {
                        const double now = double(bench.measuredTimes()) * double(seen[c]) / factor;
                        const double least = 1e-6; // floor for dark pixels; brightness around them is some hundredth
                        figures.error(std::abs(now - double(plain[c])) / (std::abs(double(plain[c])) + least), [&] {
                            return fmt::format("{}, {}, times 2^{}", infoOf(light).name, name, exponent);
                        });
                    }
                }
            }
            bench.progress(double(++done) / double(2 * std::size(maps)));
        }
    }
}

} // namespace

void addEnvironmentCases(std::vector<StressCase>& cases) {
    cases.push_back(
        {"environment/even",
         "even light from maps of one texel, row or column, or turned by 1e9 degrees, is the same light",
         StressBound::WorstRel,
         1e-3,
         "fp32 sums of the filter, and look-ups near the edges of its table; the first is held to the reference, whose "
         "samples have noise, 30 times as loosely",
         {},
         &evenMaps});
    cases.push_back({"environment/radiance",
                     "pictures are as bright as their map, from 2^-60 to 2^60 of it, with all light in one texel too",
                     StressBound::WorstRel,
                     1e-4,
                     "a power of 2 changes no digit but those below 1e-6 of the brightness",
                     &measureRadiance,
                     {}});
}

} // namespace tessera::validation
