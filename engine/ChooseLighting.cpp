#include "engine/ChooseLighting.h"

namespace tessera::engine {

frame::LightingStage chooseLighting(const frame::FrameSettings& settings) {
    return settings.lightOn.value_or(frame::LightingStage::Fragment);
}

std::optional<graph::Plan::Choice> lightingChoice(Technique technique, const frame::FrameSettings& settings) {
    if (!infoOf(technique).choosesStage) return std::nullopt;
    const char* const why = settings.lightOn ? "chosen by the setting light-on; automatic restores the default"
                            : settings.softwareBackend
                                ? "measured 15 to 40 % faster than compute shaders on software rasterisers"
                                : "not measured on this kind of backend yet; compute shaders are there too";
    return graph::Plan::Choice{"lighting in", std::string(infoOf(chooseLighting(settings)).name) + " shaders", why};
}

} // namespace tessera::engine
