#include "engine/ChooseSamples.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/Error.h"

namespace tessera::engine {

bool supportsSamples(const TechniqueInfo& info, int samples) {
    return samples == 1 || info.multisamples();
}

frame::FrameSettings settingsOn(const gpu::Capabilities& capabilities, frame::FrameSettings settings) {
    settings.softwareBackend = capabilities.isSoftware;
    settings.snapPixels = capabilities.snapPixels;
    settings.texturesAStage = capabilities.texturesAStage;
    const auto& given = capabilities.samplePlaces;
    const auto enough =
        std::ranges::find_if(given, [&](const auto& places) { return int(places.size()) >= settings.samples; });
    if (enough == given.end()) {
        std::vector<std::size_t> counts;
        for (const auto& places : given) counts.push_back(places.size());
        throw InputError(fmt::format("samples {}: this driver's 32-bit float render targets have {} samples; "
                                     "request fewer",
                                     settings.samples, fmt::join(counts, " or ")));
    }
    settings.samplePlaces = *enough;
    return settings;
}

int chooseSamples(const frame::FrameSettings& settings) {
    const auto& counts = frame::kSampleCounts;
    if (std::find(std::begin(counts), std::end(counts), settings.samples) == std::end(counts))
        throw InputError(
            fmt::format("samples {}: a pixel can have {} samples", settings.samples, fmt::join(counts, ", ")));
    // One sample needs no driver query: every texture supports it.
    const bool wasRequested = settings.samples > 1 && !settings.samplePlaces.empty();
    return wasRequested ? int(settings.samplePlaces.size()) : settings.samples;
}

std::vector<graph::Plan::Choice> sampleChoices(const frame::FrameSettings& settings) {
    if (settings.samples == 1) return {};
    const int given = chooseSamples(settings);
    if (settings.samplePlaces.empty()) {
        return {{"samples", std::to_string(settings.samples),
                 "chosen by the setting samples; a driver may give more, which only a plan that measures queries"}};
    }
    return {{"samples", std::to_string(given),
             fmt::format("the setting samples is {}; {}", settings.samples,
                         given == settings.samples ? "the driver gives as many" : "the driver's next larger number")}};
}

} // namespace tessera::engine
