#include "engine/ChooseSamples.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/Error.h"

namespace tessera::engine {

bool takesSamples(const TechniqueInfo& info, int samples) {
    return samples == 1 || info.multisamples();
}

frame::FrameSettings settingsOn(const gpu::Capabilities& capabilities, frame::FrameSettings settings) {
    settings.softwareBackend = capabilities.isSoftware;
    settings.snapPixels = capabilities.snapPixels;
    settings.texturesAStage = capabilities.texturesAStage;
    const std::vector<int>& given = capabilities.renderTargetSamples;
    const auto enough = std::lower_bound(given.begin(), given.end(), settings.samples);
    if (enough == given.end()) {
        throw InputError(fmt::format("samples {}: this driver's 32-bit float render targets have {} samples; "
                                     "ask for fewer",
                                     settings.samples, fmt::join(given, " or ")));
    }
    settings.samplesGiven = *enough;
    return settings;
}

int chooseSamples(const frame::FrameSettings& settings) {
    const auto& counts = frame::kSampleCounts;
    if (std::find(std::begin(counts), std::end(counts), settings.samples) == std::end(counts))
        throw InputError(
            fmt::format("samples {}: a pixel can have {} samples", settings.samples, fmt::join(counts, ", ")));
    // No driver is asked for one sample: every texture can have it.
    return settings.samples == 1 ? 1 : settings.samplesGiven.value_or(settings.samples);
}

std::vector<graph::Plan::Choice> sampleChoices(const frame::FrameSettings& settings) {
    if (settings.samples == 1) return {};
    if (!settings.samplesGiven) {
        return {{"samples", std::to_string(settings.samples),
                 "chosen by the setting samples; a driver may give more, which only a plan that measures asks it"}};
    }
    return {{"samples", std::to_string(*settings.samplesGiven),
             fmt::format("the setting samples is {}; {}", settings.samples,
                         *settings.samplesGiven == settings.samples ? "the driver gives as many"
                                                                    : "the driver's next larger number")}};
}

} // namespace tessera::engine
