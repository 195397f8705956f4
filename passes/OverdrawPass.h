#pragma once
#include <optional>

#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Counts the surfaces that a technique shades (or stores in its G-buffer) at each pixel, for the debug view
/// `overdraw`, which replaces the lit image. Draws the surfaces of the technique's geometry pass, in its order and with
/// its depth test.
/// Reads   the scene; depth D32F of a prepass, if the technique has one
/// Writes  overdraw RGBA32F: rgb number of fragments that pass the depth test, transparent layer included; A 1 if any.
///         Depth D32F of opaque surfaces, without a prepass. Both are of FrameSpec::samples
/// Space   lighting space, through the vertex function that every pass shares
struct OverdrawPass {
    using Surfaces = frame::SurfaceHandles::Kind;
    struct Inputs {
        frame::SurfaceHandles surfaces;
        std::optional<graph::TextureHandle> depth; ///< of a prepass
    };
    struct Outputs {
        frame::SurfaceHandles surfaces; ///< as read
        graph::TextureHandle overdraw;
        graph::TextureHandle depth;
    };
    static shader::ProgramDesc program(const frame::FrameSpec& spec, Surfaces surfaces);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs);
};

} // namespace tessera::passes
