#pragma once
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Lights every covered pixel once from the G-buffer, or shows the requested debug view, in fragment or compute shaders
/// (FrameSpec::lightOn).
/// Reads   G-buffer channels, the scene's materials, depth D32F, the frame's lights and light lists
/// Writes  radiance RGBA32F, linear, before exposure; the background where nothing is drawn
/// Space   lighting space
/// Source  Walter 2007; Heitz 2014 (shaders/lib/reflectance/brdf.glsl)
struct DeferredLightingPass {
    struct Params {
        bool visitsLights = true; ///< false: emission alone, for passes that add lights to it
    };
    struct Inputs {
        frame::GBufferHandles gbuffer;
        frame::LightingInputs lighting;
    };
    struct Outputs {
        Inputs read;
        graph::TextureHandle radiance;
    };
    static shader::ProgramDesc program(const frame::FrameSpec& spec, const Params& params);
    /// `drawn` is null in graphs that are only planned.
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Params& params, const Inputs& inputs,
                       const frame::DrawnView* drawn);
};

} // namespace tessera::passes
