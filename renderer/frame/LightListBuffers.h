#pragma once
#include <optional>
#include <vector>

#include "renderer/culling/LightLists.h"
#include "renderer/frame/FrameSpec.h"
#include "renderer/frame/GrowingTexelBuffer.h"
#include "renderer/graph/Execute.h"
#include "renderer/graph/Graph.h"

namespace tessera::frame {

/// The handles of a frame's light lists in its graph.
struct LightListHandles {
    graph::BufferHandle tiles;
    graph::BufferHandle cells;
    graph::BufferHandle entries;
    std::optional<graph::BufferHandle> reach; ///< LightListBuffers::reach, of lists that the GPU builds
};

struct LightListBuffers;

/// What a plan calls the buffers whose bytes are counted while the frame runs.
inline constexpr const char* kLightCellsName = "light_cells";
inline constexpr const char* kLightEntriesName = "light_entries";

/// Makes the buffers known to a graph. They outlive the frame, since how much they must hold is only known while it
/// runs; without `held`, for a plan, only the bytes of tiles and lights are known, and the others are 0.
LightListHandles importLightLists(graph::Graph& graph, std::size_t tiles, const LightListBuffers* held);
graph::BufferHandle importLightReach(graph::Graph& graph, std::size_t lights, const LightListBuffers* held);

/// What light lists are built from.
struct LitDepths {
    graph::TextureHandle opaque;                     ///< as opaqueDepths() says
    std::optional<graph::TextureHandle> transparent; ///< RG32F: x nearest depth, y farthest depth negated
};

/// The depths of opaque surfaces that light lists are built from: the depth buffer, D32F; with several samples a pixel
/// the range in which each is lit, RG32F: x nearest depth, y farthest depth negated, x 0 where there is no surface.
graph::TextureDesc opaqueDepths(const FrameSpec& spec);

/// Declares that a pass reads them, as `access` says.
LitDepths readLitDepths(graph::PassBuilder& pass, const FrameSpec& spec, const LitDepths& depths,
                        graph::Access access = graph::Access::Sampled);

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

    // For lists that the GPU builds: shared::CullLight each, and columns and rows that each may touch.
    GrowingTexelBuffer cullLights{"cull lights", graph::Format::Rgba32Float};
    gpu::Buffer round{"light list round", sizeof(glm::uvec4), gpu::BufferUse::Dynamic}; ///< lights first..end
    GrowingTexelBuffer reach{"light reach", graph::Format::Rg32Uint};

    /// The buffers behind the handles, for executing the graph.
    std::vector<graph::ImportedBuffer> imported(const LightListHandles& handles) const;
    /// Makes room. Throws as GrowingTexelBuffer::require().
    void requireTiles(std::size_t tiles);
    void requireLists(std::size_t cells, std::size_t entries);
    void upload(const culling::LightLists& lists);
    /// The lists of the latest frame, whoever built them; waits for the GPU.
    culling::LightLists download() const;
    /// Binds all three where the light cursor reads them.
    void bind() const;
};

} // namespace tessera::frame
