#include "renderer/graph/Access.h"

#include <array>
#include <cassert>
#include <utility>

#include <fmt/format.h>

#include "base/EnumTable.h"

namespace tessera::graph {
namespace {

// Barrier bits by access: OpenGL 4.5 core specification, section 7.13.2. A depth test may be combined with sampling of
// the same texture. Readbacks and copies of a texture go through a framebuffer (ReadPixels, BlitFramebuffer), which
// needs the framebuffer bit, or through Get/TexSubImage, which need the update bits.
constexpr Barrier kTransfer = Barrier::TransferOrUpdate | Barrier::Framebuffer;
constexpr std::array kAccesses{
    AccessInfo{Access::Sampled, "Sampled", false, true, false, false, true, Barrier::TextureFetch},
    AccessInfo{Access::ColorAttachment, "ColorAttachment", true, true, false, false, false, Barrier::Framebuffer},
    AccessInfo{Access::DepthAttachment, "DepthAttachment", true, true, false, false, false, Barrier::Framebuffer},
    AccessInfo{Access::DepthTest, "DepthTest", false, true, false, false, true,
               Barrier::Framebuffer | Barrier::TextureFetch},
    AccessInfo{Access::ImageRead, "ImageRead", false, true, false, false, true, Barrier::ShaderImage},
    AccessInfo{Access::ImageWrite, "ImageWrite", true, true, false, true, false, Barrier::ShaderImage},
    AccessInfo{Access::UniformRead, "UniformRead", false, false, true, false, true, Barrier::Uniform},
    AccessInfo{Access::StorageRead, "StorageRead", false, false, true, false, true, Barrier::ShaderStorage},
    AccessInfo{Access::StorageWrite, "StorageWrite", true, false, true, true, false, Barrier::ShaderStorage},
    AccessInfo{Access::TexelRead, "TexelRead", false, false, true, false, true, Barrier::TextureFetch},
    AccessInfo{Access::VertexRead, "VertexRead", false, false, true, false, true, Barrier::VertexAttribute},
    AccessInfo{Access::IndexRead, "IndexRead", false, false, true, false, true, Barrier::ElementArray},
    AccessInfo{Access::IndirectRead, "IndirectRead", false, false, true, false, true, Barrier::Command},
    AccessInfo{Access::Download, "Download", false, true, true, false, false, kTransfer},
    AccessInfo{Access::Upload, "Upload", true, true, true, false, false, kTransfer},
};

static_assert(isInOrder(kAccesses, &AccessInfo::access, std::size_t(Access::Upload) + 1));

std::string unfitTexture(Format format, Access access) {
    const FormatInfo& info = formatInfo(format);
    switch (access) {
    case Access::ColorAttachment:
        if (info.depth) return fmt::format("{} is a depth format; use DepthAttachment", info.name);
        break;
    case Access::DepthAttachment:
        if (!info.depth) return fmt::format("{} is a colour format; use ColorAttachment", info.name);
        break;
    case Access::DepthTest:
        if (!info.depth) return fmt::format("{} is a colour format; use Sampled", info.name);
        break;
    case Access::ImageRead:
    case Access::ImageWrite: // OpenGL 4.5 core specification, table 8.26 lists the formats of image units
        if (info.depth || format == Format::Srgb8Alpha8)
            return fmt::format("{} is no image format of OpenGL; use {}", info.name,
                               access == Access::ImageRead ? "Sampled"
                               : info.depth                ? "DepthAttachment"
                                                           : "ColorAttachment");
        break;
    default:
        break;
    }
    return {};
}

} // namespace

const AccessInfo& accessInfo(Access access) {
    assert(std::size_t(access) < kAccesses.size());
    return kAccesses[std::size_t(access)];
}

bool isAttachment(Access access) {
    return access == Access::ColorAttachment || access == Access::DepthAttachment || access == Access::DepthTest;
}

bool isOfPart(Access access) {
    return isAttachment(access) || access == Access::ImageRead || access == Access::ImageWrite;
}

std::string unfitReason(const ResourceDesc& desc, Access access) {
    const AccessInfo& info = accessInfo(access);
    if (const auto* texture = std::get_if<TextureDesc>(&desc))
        return info.ofTextures ? unfitTexture(texture->format, access)
                               : "it is a texture, and that access is of buffers";
    return info.ofBuffers ? "" : "it is a buffer, and that access is of textures";
}

std::string describeSize(const ResourceDesc& desc) {
    if (const auto* buffer = std::get_if<BufferDesc>(&desc)) return fmt::format("{} bytes", buffer->bytes);
    const auto& texture = std::get<TextureDesc>(desc);
    std::string size = fmt::format("{} x {}", texture.width, texture.height);
    if (texture.shape == Shape::Cube) size += ", a cube";
    if (texture.shape == Shape::Array) size += fmt::format(", {} layers", texture.layers);
    if (texture.levels != 1) size += fmt::format(", {} levels", texture.levels);
    if (texture.samples != 1) size += fmt::format(", {} samples", texture.samples);
    return size;
}

std::string describeBarrier(Barrier barrier) {
    static constexpr std::array<std::pair<Barrier, std::string_view>, 9> kNames{
        {{Barrier::TextureFetch, "texture fetch"},
         {Barrier::ShaderImage, "image"},
         {Barrier::ShaderStorage, "storage"},
         {Barrier::Uniform, "uniform"},
         {Barrier::Framebuffer, "framebuffer"},
         {Barrier::TransferOrUpdate, "update"},
         {Barrier::VertexAttribute, "vertices"},
         {Barrier::ElementArray, "indices"},
         {Barrier::Command, "draw commands"}}};
    std::string words;
    for (const auto& [bit, name] : kNames)
        if ((barrier & bit) != Barrier::None) words += (words.empty() ? "" : ", ") + std::string(name);
    return words;
}

} // namespace tessera::graph
