#include "renderer/frame/GrowingTexelBuffer.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "renderer/gpu/Context.h"
#include "scenes/Error.h"

namespace tessera::frame {

GrowingTexelBuffer::GrowingTexelBuffer(std::string label, graph::Format format)
    : label_(std::move(label)), format_(format), buffer_(label_, 0, gpu::BufferUse::Dynamic) {
    texels_ = std::make_unique<gpu::TexelBuffer>(label_, format_, buffer_);
}

std::size_t GrowingTexelBuffer::texelBytes() const {
    return std::size_t(graph::formatInfo(format_).bytes);
}

void GrowingTexelBuffer::require(std::size_t texels) {
    used_ = texels;
    if (texels * texelBytes() <= buffer_.bytes()) return;
    const std::size_t most = gpu::Context::current()->capabilities().maxTextureBufferTexels;
    const char* const remedy =
        "larger tiles (--tile 64), another --culling method or fewer lights (--lights N) need less";
    if (texels > most) {
        throw InputError(
            fmt::format("{} would take {} entries, and this driver reads {}: {}", label_, texels, most, remedy));
    }
    const std::size_t bytes = std::min(texels + texels / 4, most) * texelBytes();
    try {
        texels_.reset();
        buffer_ = gpu::Buffer(label_, bytes, gpu::BufferUse::Dynamic);
        texels_ = std::make_unique<gpu::TexelBuffer>(label_, format_, buffer_);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}; {}", error.what(), remedy));
    }
}

} // namespace tessera::frame
