#pragma once
#include <optional>

#include "passes/recipes/Techniques.h"
#include "renderer/frame/FrameSettings.h"
#include "renderer/graph/Plan.h"

namespace tessera::recipes {

/// The shaders that light: what was asked for, else fragment shaders. Throws InputError when it was asked and the
/// technique lights as it rasterises.
frame::LightingStage chooseLighting(Technique technique, const frame::FrameSettings& settings);

/// The same in words, for a plan; none for techniques without the choice.
std::optional<graph::Plan::Choice> lightingChoice(Technique technique, const frame::FrameSettings& settings);

} // namespace tessera::recipes
