#pragma once
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Keeps the finished picture of opaque surfaces, which bodies of glass show along the rays that they bend, while
/// transparent surfaces are drawn over it. Where some bodies spread those rays a second pass makes coarser levels.
/// Reads   radiance RGBA32F, of FrameSpec::samples, linear, before exposure; alpha what is covered; with several
/// samples
///         a pixel their depth D32F
/// Writes  behind_glass RGBA32F, one sample a pixel: rgb of what covers the pixel, times a, the share that it covers;
///         behind_glass_levels RGBA32F, the means over squares of 2 to 2^BEHIND_COARSEST pixels; with several samples
///         a pixel behind_glass_depth R32F, as it is at the centre of each on the surface that its first sample shows
struct BehindGlassPass {
    struct Inputs {
        graph::TextureHandle radiance;
        graph::TextureHandle depth;
    };
    struct Outputs {
        frame::BehindHandles behind;
    };
    static shader::ProgramDesc pictureProgram(const frame::FrameSpec& spec);
    static shader::ProgramDesc levelsProgram();
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs);
};

} // namespace tessera::passes
