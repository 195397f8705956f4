#pragma once
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Builds light lists on the GPU, by compute or fragment shaders, equal to those of LightListsPass entry for entry. The
/// lists are counted, then allocated, then filled, so they never overflow: only their size travels to the CPU. Several
/// passes of the graph: light_reach, light_depths, light_count (not for zbin), light_scan, light_room, light_lists; of
/// many lights light_count, light_sizes and light_lists once for each round over them.
/// Reads   the depths at which opaque and transparent surfaces are lit (frame::LitDepths)
/// Writes  light tiles, cells and entries (shaders/shared/light_lists.h)
/// Space   culling space (shaders/shared/culling.h)
/// Source  as LightListsPass
struct GpuLightListsPass {
    struct Inputs {
        frame::LitDepths depths;
        frame::ViewHandles view;
        graph::BufferHandle lighting; ///< shared::LightingConstants
    };
    struct Outputs {
        frame::LightListHandles lists;
    };
    static Outputs add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs,
                       const frame::DrawnView* drawn);
};

} // namespace tessera::passes
