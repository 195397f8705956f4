#pragma once
#include <optional>
#include <vector>

#include "renderer/frame/FrameResources.h"
#include "renderer/frame/FrameSpec.h"
#include "renderer/graph/Graph.h"

namespace tessera::passes {

/// Builds on the GPU, by compute or by fragment shaders, what LightListsPass builds on the CPU, entry for entry. The
/// lists are counted, then allocated, then filled, so they never overflow: only their size travels to the CPU. Several
/// passes of the graph: light_reach, light_depths, light_count (not for zbin), light_scan, light_lists.
/// Reads   depth D32F of opaque surfaces; of transparent ones RG32F, nearest and negated farthest depth
/// Writes  light tiles, cells and entries (shaders/shared/light_lists.h)
/// Space   view space
/// Source  as LightListsPass
struct GpuLightListsPass {
    struct Inputs {
        graph::TextureHandle depth;
        std::optional<graph::TextureHandle> transparentDepth;
    };
    struct Outputs {
        frame::LightListHandles lists;
    };
    static std::vector<shader::ProgramDesc> programs(const frame::FrameSpec& spec);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs,
                       const frame::FrameResources* resources);
};

} // namespace tessera::passes
