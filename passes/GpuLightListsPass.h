#pragma once
#include <vector>

#include "renderer/frame/FrameResources.h"
#include "renderer/frame/FrameSpec.h"
#include "renderer/graph/Graph.h"

namespace tessera::passes {

/// Builds on the GPU, by compute or by fragment shaders, what LightListsPass builds on the CPU, entry for entry. The
/// lists are counted, then allocated, then filled, so they never overflow: only their size travels to the CPU. Several
/// passes of the graph: light_reach, light_depths, light_count (not for zbin), light_scan, light_lists.
/// Reads   the depths at which opaque and transparent surfaces are lit (frame::LitDepths)
/// Writes  light tiles, cells and entries (shaders/shared/light_lists.h)
/// Space   view space
/// Source  as LightListsPass
struct GpuLightListsPass {
    struct Inputs {
        frame::LitDepths depths;
    };
    struct Outputs {
        frame::LightListHandles lists;
    };
    static std::vector<shader::ProgramDesc> programs(const frame::FrameSpec& spec);
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs,
                       const frame::FrameResources* resources);
};

} // namespace tessera::passes
