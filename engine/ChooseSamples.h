#pragma once
#include <string>
#include <vector>

#include "engine/Techniques.h"
#include "renderer/gpu/Capabilities.h"
#include "renderer/graph/Plan.h"

/// The samples per pixel: the requested number, limited by the technique and rounded up to a count of the driver.
namespace tessera::engine {

bool takesSamples(const TechniqueInfo& info, int samples);

/// The settings with everything that depends on the context filled in: the kind of backend, and the samples that the
/// driver gives for those asked. Throws InputError when it has no render targets of so many samples.
frame::FrameSettings settingsOn(const gpu::Capabilities& capabilities, frame::FrameSettings settings);

/// The samples of a frame's render targets. Throws InputError unless those asked for are one of frame::kSampleCounts.
int chooseSamples(const frame::FrameSettings& settings);

/// The same in words, for a plan; empty for one sample per pixel.
std::vector<graph::Plan::Choice> sampleChoices(const frame::FrameSettings& settings);

} // namespace tessera::engine
