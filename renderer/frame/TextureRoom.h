#pragma once
#include <cstddef>
#include <string>

#include "renderer/frame/FrameSpec.h"

/// How many textures programs that draw surfaces sample, and which textures of materials a frame goes without where a
/// stage of the driver may not sample as many (FrameSettings::texturesAStage).
namespace tessera::frame {

/// What a program of the frame that draws and lights surfaces samples at most.
std::size_t sampledTextures(const FrameSpec& spec);

/// Leaves slots out of the spec's features until its programs fit a stage, the last first: those that no material
/// `used` stands for reads, then what bodies of glass show of surfaces, then other slots, which become
/// FrameSpec::withoutTextures.
void leaveOutTextures(FrameSpec& spec, const FeatureSet& used);

/// Which textures of materials the frame lacks, and why; empty: none.
std::string missingTextures(const FrameSpec& spec);

} // namespace tessera::frame
