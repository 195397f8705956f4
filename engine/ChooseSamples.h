#pragma once
#include <string>
#include <vector>

#include "engine/Techniques.h"
#include "renderer/gpu/Capabilities.h"
#include "renderer/graph/Plan.h"

/// The samples per pixel: the requested number, limited by the technique and rounded up to a count of the driver.
namespace tessera::engine {

bool supportsSamples(const TechniqueInfo& info, int samples);

/// Completes the settings with properties of the context: the kind of backend, and the driver's sample positions for
/// the requested count. Throws InputError if no render target supports so many samples.
frame::FrameSettings settingsOn(const gpu::Capabilities& capabilities, frame::FrameSettings settings);

/// The sample count of a frame's render targets. Throws InputError unless the requested one is in frame::kSampleCounts.
int chooseSamples(const frame::FrameSettings& settings);

/// Describes the choice for a plan; empty for one sample per pixel.
std::vector<graph::Plan::Choice> sampleChoices(const frame::FrameSettings& settings);

} // namespace tessera::engine
