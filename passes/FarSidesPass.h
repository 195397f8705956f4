#pragma once
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Draws the back faces of bodies of glass, the nearest of each pixel: there rays leave them.
/// Reads   the scene
/// Writes  far_sides RGBA32F, one sample a pixel: xyz the unit normal as it is lit, w the depth, 0 where there is none
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
