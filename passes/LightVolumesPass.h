#pragma once
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Adds the lights to the image one by one: draws a proxy volume per light (shaders/lib/light/light_volume.glsl) where
/// a surface lies in front of its back faces, all in one draw and in document order, which blending preserves.
/// Reads   G-buffer channels, the scene's materials, depth D32F (tested and sampled), the frame's lights
/// Writes  radiance RGBA32F, linear: added to; alpha stays
/// Space   lighting space
/// Source  Hargreaves and Harris 2004, "Deferred Shading"
struct LightVolumesPass {
    struct Inputs {
        frame::GBufferHandles gbuffer;
        frame::LightingInputs lighting;
        graph::TextureHandle radiance; ///< emission and background
    };
    struct Outputs {
        frame::GBufferHandles gbuffer;  ///< as read
        frame::LightingInputs lighting; ///< as read
        graph::TextureHandle radiance;
    };
    /// Whether the frame's view sums over lights, and there are lights and lit surfaces.
    static bool isNeeded(const frame::FrameSpec& spec);
    static shader::ProgramDesc program(const frame::FrameSpec& spec);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs);
};

} // namespace tessera::passes
