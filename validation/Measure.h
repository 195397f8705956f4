#pragma once
#include "passes/recipes/Renderer.h"
#include "renderer/graph/Plan.h"

namespace tessera::validation {

/// Fills in a plan's milliseconds: each pass as the median of profiled frames, and what all that was left out would have cost,
/// the difference to frames with prune = off, drawn in turn with them.
void measurePlan(graph::Plan& plan, recipes::Renderer& renderer, recipes::Technique technique,
                 const frame::FrameSettings& settings);

} // namespace tessera::validation
