#pragma once
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Draws the nearest back faces of glass bodies per pixel, where refracted rays exit.
/// Reads   the scene
/// Writes  far_sides RGBA32F, one sample per pixel: xyz unit shading normal, w depth, 0 without a back face
/// Space   lighting space
/// Source  Wyman 2005, "An Approximate Image-Space Approach for Interactive Refraction"
struct FarSidesPass {
    struct Inputs {
        frame::SurfaceHandles surfaces;
    };
    struct Outputs {
        frame::SurfaceHandles surfaces; ///< as read
        graph::TextureHandle farSides;
        graph::TextureHandle depth;
    };
    static shader::ProgramDesc program(const frame::FrameSpec& spec);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs);
};

} // namespace tessera::passes
