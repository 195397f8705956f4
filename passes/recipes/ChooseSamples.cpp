#include "passes/recipes/ChooseSamples.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scenes/Error.h"

namespace tessera::recipes {

void requireSampleCount(int samples) {
    const auto& counts = frame::kSampleCounts;
    if (std::find(std::begin(counts), std::end(counts), samples) != std::end(counts)) return;
    throw InputError(fmt::format("--samples {}: a pixel can have {} samples", samples, fmt::join(counts, ", ")));
}

bool takesSamples(const TechniqueInfo& info, int samples) {
    return samples == 1 || info.multisamples();
}

void requireSamples(Technique technique, int samples) {
    requireSampleCount(samples);
    const TechniqueInfo& info = infoOf(technique);
    if (takesSamples(info, samples)) return;
    std::vector<std::string_view> able;
    for (const TechniqueInfo& other : techniqueTable()) {
        if (takesSamples(other, samples)) able.push_back(other.name);
    }
    throw InputError(
        fmt::format("technique {} does not take --samples {}; {} do", info.name, samples, fmt::join(able, ", ")));
}

frame::FrameSettings settingsOn(const gpu::Capabilities& capabilities, frame::FrameSettings settings) {
    settings.softwareBackend = capabilities.isSoftware;
    const std::vector<int>& given = capabilities.renderTargetSamples;
    const auto enough = std::lower_bound(given.begin(), given.end(), settings.samples);
    if (enough == given.end()) {
        throw InputError(fmt::format("--samples {}: this driver's 32-bit float render targets have {} samples; "
                                     "ask for fewer",
                                     settings.samples, fmt::join(given, " or ")));
    }
    settings.samplesGiven = *enough;
    return settings;
}

int chooseSamples(Technique technique, const frame::FrameSettings& settings) {
    requireSamples(technique, settings.samples);
    // No driver is asked for one sample: every texture can have it.
    return settings.samples == 1 ? 1 : settings.samplesGiven.value_or(settings.samples);
}

std::vector<graph::Plan::Choice> sampleChoices(const frame::FrameSettings& settings) {
    if (settings.samples == 1) return {};
    if (!settings.samplesGiven) {
        return {{"samples", std::to_string(settings.samples),
                 "asked for; a driver may give more, and none was asked (--measure does)"}};
    }
    return {{"samples", std::to_string(*settings.samplesGiven),
             fmt::format("{} asked for; {}", settings.samples,
                         *settings.samplesGiven == settings.samples ? "the driver gives as many"
                                                                    : "the driver's next larger number")}};
}

} // namespace tessera::recipes
