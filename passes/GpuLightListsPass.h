#pragma once
#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// Builds light lists on the GPU, by compute shaders, equal to those of LightListsPass entry for entry. The lists are
/// counted, then allocated, then filled, so that they never overflow: only their size is read back. Adds several
/// passes: light_reach, light_depths, light_count (not for zbin), light_scan, light_room, light_lists. Many lights are
/// split into rounds, with one light_count, light_sizes and light_lists per round.
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
