#pragma once
#include "renderer/frame/FrameResources.h"
#include "renderer/frame/FrameSpec.h"
#include "renderer/graph/Graph.h"

namespace tessera::passes {

/// Draws the depth of opaque and alpha-masked geometry, so that later passes shade each pixel once.
/// Reads   the scene
/// Writes  depth D32F, reverse-Z, cleared to 0
/// Space   lighting space, through the vertex function that every pass shares
struct DepthPrepass {
    struct Outputs {
        graph::TextureHandle depth;
    };
    static shader::ProgramDesc program(const frame::FrameSpec& spec);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const frame::FrameResources* resources);
};

} // namespace tessera::passes
