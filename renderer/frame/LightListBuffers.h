#pragma once
#include <vector>

#include "renderer/culling/LightLists.h"
#include "renderer/frame/GrowingTexelBuffer.h"
#include "renderer/graph/Graph.h"

namespace tessera::frame {

/// The handles of a frame's light lists in its graph.
struct LightListHandles {
    graph::BufferHandle tiles;
    graph::BufferHandle cells;
    graph::BufferHandle entries;
};

/// Declares that a pass's light cursor reads the lists.
LightListHandles readLightLists(graph::PassBuilder& pass, const LightListHandles& lists);

/// Light lists on the GPU (shaders/shared/light_lists.h). Only memory is kept from frame to frame.
struct LightListBuffers {
    GrowingTexelBuffer tiles{"light tiles", graph::Format::Rgba32Uint};
    GrowingTexelBuffer cells{"light cells", graph::Format::Rg32Uint};
    GrowingTexelBuffer entries{"light entries", graph::Format::R32Uint};

    // For lists that the CPU builds: memory that the depth buffer is read into.
    culling::LightListBuilder builder;
    std::vector<float> depth, transparentDepth;

    void upload(const culling::LightLists& lists);
    /// The lists of the latest frame.
    culling::LightLists download() const;
    /// Binds all three where the light cursor reads them.
    void bind() const;
};

} // namespace tessera::frame
