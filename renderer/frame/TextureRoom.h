#pragma once
#include <cstddef>
#include <string>

#include "renderer/frame/FrameSpec.h"

/// Texture units of programs that draw surfaces: their number, and the material textures that a frame drops if a stage
/// of the driver has too few (FrameSettings::texturesAStage).
namespace tessera::frame {

/// Most textures that a program of the frame samples to draw and light surfaces.
std::size_t sampledTextures(const FrameSpec& spec);

/// Drops texture slots from the spec's features, lowest priority first, until its programs fit a stage: slots that
/// materials with the features `used` do not read, then the surfaces behind glass, then other slots, which become
/// FrameSpec::withoutTextures.
void leaveOutTextures(FrameSpec& spec, const FeatureSet& used);

/// Warning: material textures that the frame lacks, and why; empty if none.
std::string missingTextures(const FrameSpec& spec);

} // namespace tessera::frame
