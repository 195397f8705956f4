#pragma once
#include <memory>
#include <string>

#include "renderer/culling/LightLists.h"
#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/TexelBuffer.h"
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

/// A buffer of whole texels that grows to what a frame needs, by a quarter more so that it seldom grows, and never
/// shrinks; its contents do not outlive growing.
class GrowingTexelBuffer {
public:
    GrowingTexelBuffer(std::string label, graph::Format format);
    /// Throws InputError with the remedy when `texels` are more than the driver can read or hold.
    void require(std::size_t texels);
    const gpu::Buffer& buffer() const { return buffer_; }
    const gpu::TexelBuffer& texels() const { return *texels_; }

private:
    std::string label_;
    graph::Format format_;
    gpu::Buffer buffer_;
    std::unique_ptr<gpu::TexelBuffer> texels_;
};

/// Light lists on the GPU (shaders/shared/light_lists.h). Only memory is kept from frame to frame.
struct LightListBuffers {
    GrowingTexelBuffer tiles{"light tiles", graph::Format::Rgba32Uint};
    GrowingTexelBuffer cells{"light cells", graph::Format::Rg32Uint};
    GrowingTexelBuffer entries{"light entries", graph::Format::R32Uint};

    // For lists that the CPU builds: memory that the depth buffer is read into.
    culling::LightListBuilder builder;
    std::vector<float> depth, transparentDepth;

    void upload(const culling::LightLists& lists);
    /// Binds all three where the light cursor reads them.
    void bind() const;
};

} // namespace tessera::frame
