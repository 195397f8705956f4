#pragma once
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Copies the finished image of opaque surfaces, which glass bodies refract, before transparent surfaces are drawn over
/// it. If some glass scatters refracted rays, a second pass makes coarser levels.
/// Reads   radiance RGBA32F, of FrameSpec::samples, linear, before exposure; A is the coverage; with several samples
///         per pixel also their depth D32F
/// Writes  behind_glass RGBA32F, one sample per pixel: rgb radiance of the covered part, times a, the covered fraction;
///         behind_glass_levels RGBA32F, means over squares of 2 to 2^BEHIND_COARSEST pixels; with several samples per
///         pixel behind_glass_depth R32F, the depth at the pixel's centre of the surface that its first sample shows
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
