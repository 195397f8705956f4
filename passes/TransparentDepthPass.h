#pragma once
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Draws the depth range in which each sample shades transparent surfaces, so that light lists cover them.
/// Reads   the scene, depth D32F of opaque surfaces
/// Writes  transparent_depth RG32F: x nearest depth at which a fragment is lit (shading_place.glsl), y farthest depth
///         negated; x is 0 without visible transparent surfaces. All are of FrameSpec::samples
/// Space   lighting space, through the vertex function that every pass shares
struct TransparentDepthPass {
    struct Inputs {
        frame::SurfaceHandles surfaces;
        graph::TextureHandle depth;
    };
    struct Outputs {
        Inputs read;
        graph::TextureHandle transparentDepth;
    };
    static std::vector<shader::ProgramDesc> programs(const frame::FrameSpec& spec);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs);
};

} // namespace tessera::passes
