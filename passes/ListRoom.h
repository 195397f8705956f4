#pragma once
#include "renderer/graph/Graph.h"

namespace tessera::passes {

/// A buffer that grows, of 0 bytes so far: PassContext::allocate() says how many.
inline constexpr graph::BufferDesc kGrowing{0, true};

/// Makes room for texels that shaders will read by a buffer texture. Throws InputError with the remedy where the driver
/// cannot read as many, std::runtime_error with it where memory runs out.
const gpu::Buffer& makeTexelRoom(const graph::PassContext& context, graph::BufferHandle handle, const char* what,
                                 std::size_t texels, graph::Format format);

/// The same for what shaders will read as a storage block.
const gpu::Buffer& makeBlockRoom(const graph::PassContext& context, graph::BufferHandle handle, const char* what,
                                 std::size_t bytes);

/// Throws InputError with the remedy where shaders of this driver cannot read as many texels of a buffer.
void requireReadable(const char* what, std::size_t texels);

/// Throws InputError with the remedy where shaders of this driver cannot write as many bytes.
void requireWritable(const char* what, std::size_t bytes);

} // namespace tessera::passes
