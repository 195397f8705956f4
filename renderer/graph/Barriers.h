#pragma once
#include "renderer/graph/Compile.h"

namespace tessera::graph {

/// Fills CompiledPass::before and CompiledGraph::after.
///
/// Source: OpenGL 4.5 core specification, section 7.13.2 "Shader Memory Access Synchronization". GL orders commands and
/// their effects by itself, except for stores by shaders (ImageWrite, StorageWrite):
/// - Read or write after a store: needs the barrier bit of the *later* access, whatever kind the store was.
/// - Store after a load or fetch by an earlier pass: needs the bit of the store, which also holds stores back until
///   all memory accesses begun earlier are complete.
/// Hazards are tracked per allocation, so aliased resources share them. A bit covers every store before it and is not
/// repeated until the next store. An earlier frame may have read allocations and imported resources, so the first
/// store to each needs a barrier too. `after` makes this frame's stores visible to the next and to readers of outputs.
void placeBarriers(const Graph& graph, CompiledGraph& compiled);

} // namespace tessera::graph
