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

namespace tessera::gpu {
namespace {

std::uint64_t nextSerial() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

std::string describe(const std::string& label, const graph::TextureDesc& desc) {
    const std::string samples = desc.samples > 1 ? fmt::format(", {} samples", desc.samples) : "";
    return fmt::format("texture '{}' ({} x {} {}{})", label, desc.width, desc.height,
                       graph::formatInfo(desc.format).name, samples);
}

void checkDesc(const std::string& label, const graph::TextureDesc& desc, int mipLevels) {
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
    assert(mipLevels >= 1 && mipLevels <= mipLevelsFor(desc.width, desc.height));
    assert((desc.samples == 1 || mipLevels == 1) && "a multisampled texture has one level");
    static_cast<void>(mipLevels);
}

} // namespace

int mipLevelsFor(int width, int height) {
    return std::bit_width(unsigned(std::max({width, height, 1})));
}

graph::TextureDesc mipDesc(const graph::TextureDesc& desc, int level) {
    graph::TextureDesc result = desc;
    result.width = std::max(1, desc.width >> level);
    result.height = std::max(1, desc.height >> level);
    return result;
}

Texture::Texture(std::string label, const graph::TextureDesc& desc, int mipLevels)
    : label_(std::move(label)), desc_(desc), mipLevels_(mipLevels),
      serial_(std::make_shared<const std::uint64_t>(nextSerial())) {
    throwIfFailed(fmt::format("before creating texture '{}'", label_));
    checkDesc(label_, desc, mipLevels);
    const bool multisampled = desc.samples > 1;
    const GLenum internalFormat = glFormat(desc.format).internalFormat;
    std::uint32_t id = 0;
    glCreateTextures(multisampled ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D, 1, &id);
    id_ = Id(id);
    if (multisampled) {
        glTextureStorage2DMultisample(id, desc.samples, internalFormat, desc.width, desc.height, GL_TRUE);
    } else {
        glTextureStorage2D(id, mipLevels, internalFormat, desc.width, desc.height);
        glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    labelObject(LabelKind::Texture, id, label_);
    std::size_t bytes = 0;
    for (int level = 0; level < mipLevels; ++level) bytes += levelBytes(level);
    try {
        throwIfAllocationFailed(describe(label_, desc), bytes);
    } catch (...) {
        glDeleteTextures(1, &id);
        throw;
    }
}

Texture::~Texture() {
    if (const std::uint32_t id = id_.value()) glDeleteTextures(1, &id);
}

std::size_t Texture::levelBytes(int level) const {
    const graph::TextureDesc size = mipDesc(desc_, level);
    return std::size_t(size.width) * std::size_t(size.height) * std::size_t(size.samples) *
           std::size_t(graph::formatInfo(desc_.format).bytes);
}

void Texture::upload(int level, std::span<const std::byte> texels) const {
    assert(desc_.samples == 1 && level >= 0 && level < mipLevels_);
    assert(texels.size() == levelBytes(level) && "an upload replaces a whole level");
    const GlFormat& format = glFormat(desc_.format);
    const graph::TextureDesc size = mipDesc(desc_, level);
    glTextureSubImage2D(id_.value(), level, 0, 0, size.width, size.height, format.transferFormat, format.transferType,
                        texels.data());
    throwIfAllocationFailed(describe(label_, desc_), levelBytes(level));
}

void Texture::generateMips() const {
    glGenerateTextureMipmap(id_.value());
    throwIfAllocationFailed(describe(label_, desc_), levelBytes(0));
}

std::vector<std::byte> Texture::downloadBytes(int level) const {
    std::vector<std::byte> texels(levelBytes(level));
    downloadInto(level, texels);
    return texels;
}

void Texture::downloadInto(int level, std::span<std::byte> texels) const {
    assert(level >= 0 && level < mipLevels_);
    if (desc_.samples > 1)
        throw std::runtime_error(
            fmt::format("{} cannot be read back; resolve it with blit() first", describe(label_, desc_)));
    assert(texels.size() == levelBytes(level));
    const GlFormat& format = glFormat(desc_.format);
    // GL counts in a signed 32-bit size; larger levels are read in bands of rows.
    const graph::TextureDesc size = mipDesc(desc_, level);
    const std::size_t rowBytes = texels.size() / std::size_t(size.height);
    const int rowsAtOnce = int(std::clamp<std::size_t>((std::size_t(1) << 30) / rowBytes, 1, std::size_t(size.height)));
    for (int row = 0; row < size.height; row += rowsAtOnce) {
        const int rows = std::min(rowsAtOnce, size.height - row);
        glGetTextureSubImage(id_.value(), level, 0, row, 0, size.width, rows, 1, format.transferFormat,
                             format.transferType, GLsizei(rowBytes * std::size_t(rows)),
                             texels.data() + rowBytes * std::size_t(row));
    }
    throwIfFailed(fmt::format("reading {}", describe(label_, desc_)));
}

} // namespace tessera::gpu
