#pragma once
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Draws the triangles visible in each pixel, for the debug view `ids`, which replaces the lit image.
/// Reads   the scene
/// Writes  ids RGBA32F: R 1 + the opaque surface's mesh instance in document order, 0 without one; G its triangle in
///         the mesh; B the sum of a number below 2^16 per transparent surface in front; A the coverage. Depth D32F of
///         opaque surfaces. Both are of FrameSpec::samples. With FrameSettings::idsOfNearest transparent surfaces count
///         as opaque, and B is 0
/// Space   lighting space, through the vertex function that every pass shares
struct IdsPass {
    using Surfaces = frame::SurfaceHandles::Kind;
    struct Inputs {
        frame::SurfaceHandles surfaces;
    };
    struct Outputs {
        Inputs read;
        graph::TextureHandle ids;
        graph::TextureHandle depth;
    };
    static shader::ProgramDesc program(const frame::FrameSpec& spec, Surfaces surfaces);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs);
};

} // namespace tessera::passes
