#pragma once
#include <optional>

#include "engine/Techniques.h"
#include "renderer/frame/FrameSettings.h"
#include "renderer/graph/Plan.h"

namespace tessera::engine {

/// The stage of the lighting shaders: the requested one, which the technique must support, else fragment shaders.
frame::LightingStage chooseLighting(const frame::FrameSettings& settings);

/// Describes the choice for a plan; none for techniques without it.
std::optional<graph::Plan::Choice> lightingChoice(Technique technique, const frame::FrameSettings& settings);

} // namespace tessera::engine
