#pragma once
#include "renderer/graph/Graph.h"

namespace tessera::passes {

/// A growing buffer whose size PassContext::allocate() sets.
inline constexpr graph::BufferDesc kGrowing{0, true};

/// Allocates texels that shaders read as a buffer texture. Throws InputError if the driver cannot read that many,
/// std::runtime_error if memory runs out; both name the remedy.
const gpu::Buffer& makeTexelRoom(const graph::PassContext& context, graph::BufferHandle handle, const char* what,
                                 std::size_t texels, graph::Format format);

/// The same for bytes that shaders read as a storage block.
const gpu::Buffer& makeBlockRoom(const graph::PassContext& context, graph::BufferHandle handle, const char* what,
                                 std::size_t bytes);

/// Throws InputError with the remedy if shaders of this driver cannot read that many texels of a buffer.
void requireReadable(const char* what, std::size_t texels);

/// Throws InputError with the remedy if shaders of this driver cannot write that many bytes.
void requireWritable(const char* what, std::size_t bytes);

} // namespace tessera::passes
