#include "renderer/gpu/TexelReader.h"

#include <cassert>
#include <cstdint>
#include <utility>

#include <glad/gl.h>

#include "renderer/gpu/Debug.h"
#include "renderer/gpu/GlFormat.h"

namespace tessera::gpu {

TexelReader::TexelReader() : buffer_("single texels", kMostTextures * kTexelBytes, BufferUse::Readback) {}

TexelReader::~TexelReader() {
    forget();
}

void TexelReader::forget() {
    if (fence_ != nullptr) glDeleteSync(static_cast<GLsync>(std::exchange(fence_, nullptr)));
}

void TexelReader::request(std::span<const Texture* const> textures, glm::ivec2 texel) {
    assert(textures.size() <= kMostTextures);
    forget();
    glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer_.id());
    for (std::size_t i = 0; i < textures.size(); ++i) {
        const Texture& texture = *textures[i];
        assert(texel.x >= 0 && texel.y >= 0 && texel.x < texture.desc().width && texel.y < texture.desc().height);
        const GlFormat& format = glFormat(texture.desc().format);
        glGetTextureSubImage(texture.id(), 0, texel.x, texel.y, 0, 1, 1, 1, format.transferFormat, format.transferType,
                             GLsizei(kTexelBytes), reinterpret_cast<void*>(std::uintptr_t(i * kTexelBytes)));
    }
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    throwIfFailed("requesting single texels");
    requested_ = textures.size();
    fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

std::optional<std::vector<TexelReader::Texel>> TexelReader::take() {
    if (fence_ == nullptr) return std::nullopt;
    const GLenum state = glClientWaitSync(static_cast<GLsync>(fence_), GL_SYNC_FLUSH_COMMANDS_BIT, 0);
    if (state == GL_TIMEOUT_EXPIRED) return std::nullopt;
    forget();
    return buffer_.downloadAs<Texel>(requested_);
}

} // namespace tessera::gpu
