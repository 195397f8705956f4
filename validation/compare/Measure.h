#pragma once
#include "engine/Renderer.h"
#include "renderer/graph/Plan.h"

namespace tessera::validation {

/// Fills in a plan's milliseconds: each pass as the median of profiled frames, and what all that was left out would
/// have cost, the difference to frames with prune = off, drawn in turn with them. The bytes of light
/// lists, which are counted while a frame runs, are filled in too, and their entries become a counter. With a range
/// tolerance also adds the dropped light, as a choice.
void measurePlan(graph::Plan& plan, engine::Renderer& renderer, engine::Technique technique,
                 const frame::FrameSettings& settings);

/// Median wall time in milliseconds of a whole frame by each technique, from its first call to the return of glFinish.
/// The techniques take turns, so that a machine that changes its pace treats all alike.
std::vector<double> frameMs(engine::Renderer& renderer, const std::vector<engine::Technique>& techniques,
                            const frame::FrameSettings& settings, int frames);

} // namespace tessera::validation
