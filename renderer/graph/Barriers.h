#pragma once
#include "renderer/graph/Compile.h"

namespace tessera::graph {

/// Fills CompiledPass::before and CompiledGraph::after.
///
/// Source: OpenGL 4.5 core specification, section 7.13.2 "Shader Memory Access Synchronization". GL orders commands and
/// their effects by itself, except for stores by shaders (ImageWrite, StorageWrite):
/// - Read or write after a store: the later access needs the barrier bit of *its own* kind, whatever kind the store
/// was.
/// - Store after a load or fetch by an earlier pass: the bit of the store's kind, which also holds stores back until
///   all memory accesses begun earlier are complete.
/// Memory, not the resource, is what counts: the tenants of one allocation share their hazards. A bit covers every
/// store before it, so once issued it is not repeated until the next store. Allocations and imported resources come
/// from an earlier frame that may have read them, so the first store to each is held back too; stores of this frame are
/// made visible to the next one, and to readers of the outputs, by `after`.
void placeBarriers(const Graph& graph, CompiledGraph& compiled);

} // namespace tessera::graph
