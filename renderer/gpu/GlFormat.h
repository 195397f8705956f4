#pragma once
#include <cstdint>

#include "renderer/graph/Format.h"

namespace tessera::gpu {

/// The GLenum values of a graph::Format; the table behind glFormat() is the only list of them.
struct GlFormat {
    graph::Format format;
    std::uint32_t internalFormat; ///< sized
    std::uint32_t transferFormat; ///< of uploads and downloads
    std::uint32_t transferType;
    bool inTexelBuffers; ///< allowed in buffer textures (OpenGL 4.5, table 8.26)
    bool inImages;       ///< allowed in image units (OpenGL 4.5, table 8.33)
};

const GlFormat& glFormat(graph::Format format);

} // namespace tessera::gpu
