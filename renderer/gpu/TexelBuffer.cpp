#include "renderer/gpu/TexelBuffer.h"

#include <stdexcept>

#include <fmt/format.h>
#include <glad/gl.h>

#include "renderer/gpu/Context.h"
#include "renderer/gpu/Debug.h"
#include "renderer/gpu/GlFormat.h"

namespace tessera::gpu {

TexelBuffer::TexelBuffer(std::string label, graph::Format format, const Buffer& buffer)
    : texels_(buffer.bytes() / std::size_t(graph::formatInfo(format).bytes)) {
    if (!glFormat(format).inTexelBuffers)
        throw std::runtime_error(
            fmt::format("texel buffer '{}': buffer textures cannot be {}", label, graph::formatInfo(format).name));
    const std::size_t most = Context::current()->capabilities().maxTextureBufferTexels;
    if (texels_ > most)
        throw std::runtime_error(fmt::format("texel buffer '{}' has {} texels; this driver reads {} at most; use fewer "
                                             "lights or smaller tiles",
                                             label, texels_, most));
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
