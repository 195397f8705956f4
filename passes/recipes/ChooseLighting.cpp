#include "passes/recipes/ChooseLighting.h"

#include <fmt/format.h>

#include "scenes/Error.h"

namespace tessera::recipes {

frame::LightingStage chooseLighting(Technique technique, const frame::FrameSettings& settings) {
    if (!settings.lightOn) return frame::LightingStage::Fragment;
    if (infoOf(technique).choosesStage) return *settings.lightOn;
    std::string techniques;
    for (const TechniqueInfo& other : techniqueTable()) {
        if (other.choosesStage) techniques += (techniques.empty() ? "" : ", ") + std::string(other.name);
    }
    throw InputError(fmt::format("technique {} does not take --light-on {}, since it lights as it rasterises; {} do",
                                 infoOf(technique).name, infoOf(*settings.lightOn).name, techniques));
}

std::optional<graph::Plan::Choice> lightingChoice(Technique technique, const frame::FrameSettings& settings) {
    if (!infoOf(technique).choosesStage) return std::nullopt;
    const char* const why = settings.lightOn ? "asked for"
                            : settings.softwareBackend
                                ? "measured 15 to 40 % faster than compute shaders on software rasterisers"
                                : "not measured on this kind of backend yet; compute is there by --light-on compute";
    return graph::Plan::Choice{"lighting in",
                               std::string(infoOf(chooseLighting(technique, settings)).name) + " shaders", why};
}

} // namespace tessera::recipes
