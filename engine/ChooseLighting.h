#pragma once
#include <optional>

#include "engine/Techniques.h"
#include "renderer/frame/FrameSettings.h"
#include "renderer/graph/Plan.h"

namespace tessera::engine {

/// The stage of the lighting shaders: the requested one, which the technique must take, else fragment shaders.
frame::LightingStage chooseLighting(const frame::FrameSettings& settings);

/// The same in words, for a plan; none for techniques without the choice.
std::optional<graph::Plan::Choice> lightingChoice(Technique technique, const frame::FrameSettings& settings);

} // namespace tessera::engine
