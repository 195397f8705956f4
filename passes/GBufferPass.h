#pragma once
#include <vector>

#include "renderer/frame/FrameResources.h"
#include "renderer/frame/FrameSpec.h"
#include "renderer/graph/Graph.h"

namespace tessera::passes {

/// Stores the nearest opaque or alpha-masked surface of each pixel.
/// Reads   the scene
/// Writes  the channels of FrameSpec::channels in the layout's textures (renderer/frame/GBufferLayout.h), depth D32F
///         reverse-Z
/// Space   lighting space
struct GBufferPass {
    struct Outputs {
        std::vector<graph::TextureHandle> textures; ///< by attachment, as FrameSpec::gbufferTextures()
        graph::TextureHandle depth;
    };
    static shader::ProgramDesc program(const frame::FrameSpec& spec);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const frame::FrameResources* resources);
};

} // namespace tessera::passes
