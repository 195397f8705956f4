#include "renderer/gpu/Texture.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <stdexcept>

#include <fmt/format.h>
#include <glad/gl.h>

#include "renderer/gpu/Context.h"
#include "renderer/gpu/Debug.h"
#include "renderer/gpu/GlFormat.h"
#include "renderer/graph/Access.h"

namespace tessera::gpu {
namespace {

std::uint64_t nextSerial() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

std::string describe(const std::string& label, const graph::TextureDesc& desc) {
    return fmt::format("texture '{}' ({} {})", label, graph::describeSize(desc), graph::formatInfo(desc.format).name);
}

GLenum targetOf(const graph::TextureDesc& desc) {
    if (desc.samples > 1) return GL_TEXTURE_2D_MULTISAMPLE;
    switch (desc.shape) {
    case graph::Shape::Array:
        return GL_TEXTURE_2D_ARRAY;
    case graph::Shape::Cube:
        return GL_TEXTURE_CUBE_MAP;
    case graph::Shape::Flat:
        break;
    }
    return GL_TEXTURE_2D;
}

void checkDesc(const std::string& label, const graph::TextureDesc& desc) {
    const Capabilities& capabilities = Context::current()->capabilities();
    const std::string what = describe(label, desc);
    if (desc.width < 1 || desc.height < 1 || desc.samples < 1)
        throw std::runtime_error(fmt::format("{} has no texel; every size must be 1 or more", what));
    if (std::max(desc.width, desc.height) > capabilities.maxTextureSize)
        throw std::runtime_error(fmt::format("{} is larger than this driver's limit of {} texels a side; "
                                             "use a smaller picture",
                                             what, capabilities.maxTextureSize));
    if (desc.samples > capabilities.maxSamples)
        throw std::runtime_error(
            fmt::format("{} has more samples than this driver's limit of {}", what, capabilities.maxSamples));
    assert(desc.levels >= 1 && desc.levels <= graph::mipLevelsFor(desc.width, desc.height));
    assert((desc.samples == 1 || (desc.levels == 1 && desc.shape == graph::Shape::Flat)) &&
           "several samples, one part");
    assert(desc.shape != graph::Shape::Cube || (desc.layers == 6 && desc.width == desc.height));
    assert(desc.shape != graph::Shape::Flat || desc.layers == 1);
}

} // namespace

Texture::Texture(std::string label, const graph::TextureDesc& desc)
    : label_(std::move(label)), desc_(desc), serial_(std::make_shared<const std::uint64_t>(nextSerial())) {
    throwIfFailed(fmt::format("before creating texture '{}'", label_));
    checkDesc(label_, desc);
    const bool multisampled = desc.samples > 1;
    const GLenum internalFormat = glFormat(desc.format).internalFormat;
    std::uint32_t id = 0;
    glCreateTextures(targetOf(desc), 1, &id);
    id_ = Id(id);
    if (multisampled) {
        glTextureStorage2DMultisample(id, desc.samples, internalFormat, desc.width, desc.height, GL_TRUE);
    } else {
        if (desc.shape == graph::Shape::Array)
            glTextureStorage3D(id, desc.levels, internalFormat, desc.width, desc.height, desc.layers);
        else
            glTextureStorage2D(id, desc.levels, internalFormat, desc.width, desc.height);
        glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    labelObject(LabelKind::Texture, id, label_);
    try {
        throwIfAllocationFailed(describe(label_, desc), graph::descBytes(desc));
    } catch (...) {
        glDeleteTextures(1, &id);
        throw;
    }
}

Texture::~Texture() {
    if (const std::uint32_t id = id_.value()) glDeleteTextures(1, &id);
}

std::size_t Texture::levelBytes(int level) const {
    return graph::descBytes(graph::mipDesc(desc_, level)) / std::size_t(desc_.layers);
}

void Texture::upload(int level, std::span<const std::byte> texels, int layer) const {
    assert(desc_.samples == 1 && level >= 0 && level < desc_.levels && layer >= 0 && layer < desc_.layers);
    assert(texels.size() == levelBytes(level) && "an upload replaces a whole level");
    const GlFormat& format = glFormat(desc_.format);
    const graph::TextureDesc size = graph::mipDesc(desc_, level);
    if (desc_.shape == graph::Shape::Flat)
        glTextureSubImage2D(id_.value(), level, 0, 0, size.width, size.height, format.transferFormat,
                            format.transferType, texels.data());
    else
        glTextureSubImage3D(id_.value(), level, 0, 0, layer, size.width, size.height, 1, format.transferFormat,
                            format.transferType, texels.data());
    throwIfAllocationFailed(describe(label_, desc_), levelBytes(level));
}

void Texture::clear() const {
    const GlFormat& format = glFormat(desc_.format);
    for (int level = 0; level < desc_.levels; ++level)
        glClearTexImage(id_.value(), level, format.transferFormat, format.transferType, nullptr);
}

void Texture::generateMips() const {
    glGenerateTextureMipmap(id_.value());
    throwIfAllocationFailed(describe(label_, desc_), levelBytes(0));
}

std::vector<std::byte> Texture::downloadBytes(int level, int layer) const {
    std::vector<std::byte> texels(levelBytes(level));
    downloadInto(level, texels, layer);
    return texels;
}

void Texture::downloadInto(int level, std::span<std::byte> texels, int layer) const {
    assert(texels.size() == levelBytes(level));
    const GlFormat& format = glFormat(desc_.format);
    readLevel(format.transferFormat, format.transferType, level, texels, layer);
}

std::vector<glm::uvec4> Texture::downloadComponents(int level, int layer) const {
    const graph::FormatInfo& info = graph::formatInfo(desc_.format);
    const graph::TextureDesc size = graph::mipDesc(desc_, level);
    std::vector<glm::uvec4> texels(std::size_t(size.width) * std::size_t(size.height));
    const std::span<std::byte> bytes = std::as_writable_bytes(std::span(texels));
    if (!info.depth) {
        readLevel(info.integer ? GL_RGBA_INTEGER : GL_RGBA, info.integer ? GL_UNSIGNED_INT : GL_FLOAT, level, bytes,
                  layer);
        return texels;
    }
    const std::vector<float> depths = downloadAs<float>(level, layer);
    const auto bits = [](float number) { return std::bit_cast<std::uint32_t>(number); };
    std::ranges::transform(depths, texels.begin(),
                           [&](float depth) { return glm::uvec4(bits(depth), 0u, 0u, bits(1.0f)); });
    return texels;
}

void Texture::readLevel(std::uint32_t transferFormat, std::uint32_t transferType, int level,
                        std::span<std::byte> texels, int layer) const {
    assert(level >= 0 && level < desc_.levels && layer >= 0 && layer < desc_.layers);
    if (desc_.samples > 1)
        throw std::runtime_error(
            fmt::format("{} cannot be read back; resolve it with blit() first", describe(label_, desc_)));
    // GL takes a signed 32-bit size; larger levels are read in bands of rows.
    const graph::TextureDesc size = graph::mipDesc(desc_, level);
    const std::size_t rowBytes = texels.size() / std::size_t(size.height);
    const int rowsAtOnce = int(std::clamp<std::size_t>((std::size_t(1) << 30) / rowBytes, 1, std::size_t(size.height)));
    for (int row = 0; row < size.height; row += rowsAtOnce) {
        const int rows = std::min(rowsAtOnce, size.height - row);
        glGetTextureSubImage(id_.value(), level, 0, row, layer, size.width, rows, 1, transferFormat, transferType,
                             GLsizei(rowBytes * std::size_t(rows)), texels.data() + rowBytes * std::size_t(row));
    }
    throwIfFailed(fmt::format("reading {}", describe(label_, desc_)));
}

} // namespace tessera::gpu
