#pragma once
#include <string>
#include <vector>

#include "passes/recipes/Techniques.h"
#include "renderer/gpu/Capabilities.h"
#include "renderer/graph/Plan.h"

/// How many samples a pixel has: what was asked for, what the technique takes and what the driver gives.
namespace tessera::recipes {

/// Throws InputError unless it is one of frame::kSampleCounts.
void requireSampleCount(int samples);

/// Throws InputError naming the techniques that take so many samples when this one does not.
void requireSamples(Technique technique, int samples);
bool takesSamples(const TechniqueInfo& info, int samples);

/// The settings with everything that depends on the context filled in: the kind of backend, and the samples that the
/// driver gives for those asked. Throws InputError when it has no render targets of so many samples.
frame::FrameSettings settingsOn(const gpu::Capabilities& capabilities, frame::FrameSettings settings);

/// The samples of a frame's render targets. Throws InputError as the functions above do.
int chooseSamples(Technique technique, const frame::FrameSettings& settings);

/// The same in words, for a plan; empty for one sample a pixel.
std::vector<graph::Plan::Choice> sampleChoices(const frame::FrameSettings& settings);

} // namespace tessera::recipes
