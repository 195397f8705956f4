#pragma once
#include "engine/Renderer.h"
#include "renderer/graph/Plan.h"

namespace tessera::validation {

/// Fills in a plan's milliseconds: each pass as the median of profiled frames, and the cost of everything pruned as the
/// difference from frames with prune = off, drawn in turn with them. Also fills in the bytes of light lists, which are
/// counted while a frame runs, and adds their cells and entries as counters. With a range tolerance, adds the dropped
/// light as a choice.
void measurePlan(graph::Plan& plan, engine::Renderer& renderer, engine::Technique technique,
                 const frame::FrameSettings& settings);

/// Median wall time in milliseconds of a whole frame per technique, from its first call to the return of glFinish. The
/// techniques take turns, so that changes in the machine's speed affect all alike.
std::vector<double> frameMs(engine::Renderer& renderer, const std::vector<engine::Technique>& techniques,
                            const frame::FrameSettings& settings, int frames);

} // namespace tessera::validation
