#pragma once
#include "renderer/frame/FrameHandles.h"
#include "renderer/frame/FrameSpec.h"
#include "renderer/graph/Graph.h"

namespace tessera::passes {

/// Draws the environment where no opaque surface was drawn.
///
/// Reads   the environment's map, or its filtered one for a blurred backdrop; depth D32F, reverse-Z, 0 where empty
/// Writes  radiance RGBA32F, linear, before exposure; A, the coverage, stays 0
class BackdropPass {
public:
    struct Inputs {
        frame::ViewHandles view;
        frame::EnvironmentHandles environment;
        graph::TextureHandle depth;
        graph::TextureHandle radiance;
    };
    struct Outputs {
        frame::ViewHandles view;
        frame::EnvironmentHandles environment;
        graph::TextureHandle depth;
        graph::TextureHandle radiance;
    };
    static shader::ProgramDesc program(const frame::FrameSpec& spec);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs);
};

} // namespace tessera::passes
