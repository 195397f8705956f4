// Light counts around the sizes of words, batches and workgroups, which lists and loops tend to miscount.
#include <algorithm>

#include <fmt/format.h>

#include "validation/stress/StressCase.h"
#include "validation/stress/StressRandom.h"
#include "validation/stress/StressScene.h"

namespace tessera::validation {

namespace {

constexpr int kCounts[] = {1, 31, 32, 33, 255, 256, 257, 1024, 4097, 65536};
constexpr int kQuickCount = 1024;
constexpr double kManyLightTolerance = 1e-4;
constexpr const char* kManyLightReason =
    "N positive terms summed in fp32 differ by at most N 2^-24, 6e-5 for 1024, and by 3e-6 for each; errors of more "
    "lights count 1024/N";

frame::FrameSettings settingsOf(int width, int height) {
    frame::FrameSettings settings;
    settings.sizePixels = {width, height};
    settings.display = false;
    return settings;
}

std::vector<StressPicture> picturesOf(StressEffort effort, const char* what,
                                      void (*addLights)(scenes::Scene& scene, int count)) {
    std::vector<StressPicture> pictures;
    for (const int count : kCounts) {
        if (effort == StressEffort::Quick && count > kQuickCount) continue;
        StressPicture picture{fmt::format("{} {}", count, what), stressFloor(), settingsOf(33, 33)};
        picture.allowed = std::max(1.0, count / 1024.0);
        addLights(picture.scene, count);
        pictures.push_back(std::move(picture));
    }
    return pictures;
}

/// One light without range, so that the image is not black, and all others above one tile's corner.
void crowd(scenes::Scene& scene, int count) {
    StressRandom random(41);
    scene.lights = {stressLight({0.0, 1.0, 0.0}, 1.0f)};
    for (int i = 1; i < count; ++i) {
        const glm::dvec3 placeWS(random.between(-0.8, -0.6), random.between(0.1, 0.2), random.between(-0.8, -0.6));
        scene.lights.push_back(stressLight(placeWS, 2.0f / float(count)));
        scene.lights.back().rangeMetres = 0.3f;
    }
}

void identical(scenes::Scene& scene, int count) {
    scene.lights.assign(std::size_t(count), stressLight({0.1, 1.0, 0.2}, 1.0f / float(count)));
    for (scenes::Light& light : scene.lights) light.rangeMetres = 5.0f;
}

/// Lights at random positions with random colours and ranges.
void scattered(scenes::Scene& scene, int count) {
    StressRandom random(42);
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 placeWS(random.between(-1.0, 1.0), random.between(0.05, 0.5), random.between(-1.0, 1.0));
        scene.lights.push_back(stressLight(placeWS, 1.0f / float(count)));
        scene.lights.back().color = random.color();
        scene.lights.back().rangeMetres = i == 0 ? 10.0f : float(random.between(0.1, 1.5));
    }
}

} // namespace

void addManyLightCases(std::vector<StressCase>& cases) {
    const auto add = [&cases](const char* name, const char* holds, const char* what, auto addLights) {
        cases.push_back({name,
                         holds,
                         StressBound::WorstRel,
                         kManyLightTolerance,
                         kManyLightReason,
                         {},
                         [what, addLights](StressEffort effort) { return picturesOf(effort, what, addLights); }});
    };
    add("lights/one_tile", "1 to 65,536 lights, all but one in one tile", "lights, most in one tile", &crowd);
    add("lights/identical", "1 to 65,536 lights, all the same", "identical lights", &identical);
    add("lights/scattered", "1 to 65,536 lights, each with its own range", "scattered lights", &scattered);
}

} // namespace tessera::validation
