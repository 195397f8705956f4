#pragma once
#include <optional>

#include "renderer/frame/FrameResources.h"
#include "renderer/frame/FrameSpec.h"
#include "renderer/graph/Graph.h"

namespace tessera::passes {

/// Builds the light lists of FrameSpec::culling from the depths of what will be lit.
/// Reads   depth D32F of opaque surfaces; of transparent ones RG32F, nearest and negated farthest depth
/// Writes  light tiles, cells and entries (shaders/shared/light_lists.h)
/// Space   view space
/// Source  Harada 2012, "A 2.5D Culling for Forward+"; Olsson 2012, "Clustered Deferred and Forward Shading"; Drobot
/// 2017, "Improved Culling for Tiled and Clustered Rendering"
struct LightListsPass {
    struct Inputs {
        graph::TextureHandle depth;
        std::optional<graph::TextureHandle> transparentDepth;
    };
    struct Outputs {
        Inputs read;
        frame::LightListHandles lists;
    };
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs,
                       const frame::FrameResources* resources);
};

} // namespace tessera::passes
