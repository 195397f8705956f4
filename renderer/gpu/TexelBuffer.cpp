#include "renderer/gpu/TexelBuffer.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <glad/gl.h>

#include "renderer/gpu/Context.h"
#include "renderer/gpu/Debug.h"
#include "renderer/gpu/GlFormat.h"

namespace tessera::gpu {

// OpenGL 4.5 core, section 8.9: buffer textures are truncated to the driver's texel limit.
TexelBuffer::TexelBuffer(std::string label, graph::Format format, const Buffer& buffer)
    : texels_(std::min(buffer.bytes() / std::size_t(graph::formatInfo(format).bytes),
                       std::size_t(Context::current()->capabilities().maxTextureBufferTexels))) {
    if (!glFormat(format).inTexelBuffers)
        throw std::runtime_error(
            fmt::format("texel buffer '{}': buffer textures cannot be {}", label, graph::formatInfo(format).name));
    std::uint32_t id = 0;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &id);
    glTextureBuffer(id, glFormat(format).internalFormat, buffer.id());
    labelObject(LabelKind::Texture, id, label);
    id_ = Id(id);
    try {
        throwIfFailed(fmt::format("creating texel buffer '{}'", label));
    } catch (...) {
        glDeleteTextures(1, &id);
        throw;
    }
}

TexelBuffer::~TexelBuffer() {
    if (const std::uint32_t id = id_.value()) glDeleteTextures(1, &id);
}

} // namespace tessera::gpu
