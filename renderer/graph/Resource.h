#pragma once
#include <cstddef>
#include <cstdint>
#include <variant>

#include "renderer/graph/Format.h"

/// What passes exchange: shapes of textures and buffers, handles that name them, and the ways of using them.
namespace tessera::graph {

struct TextureDesc {
    Format format = Format::Rgba32Float;
    int width = 0;  ///< texels
    int height = 0; ///< texels
    int samples = 1;
    bool operator==(const TextureDesc&) const = default;
};

struct BufferDesc {
    std::size_t bytes = 0;
    bool operator==(const BufferDesc&) const = default;
};

using ResourceDesc = std::variant<TextureDesc, BufferDesc>;
std::size_t descBytes(const ResourceDesc& desc);

/// Names one version of a resource: writing gives a new version, and the old handle is stale from then on.
template <typename Tag>
struct Handle {
    static constexpr std::uint32_t kInvalid = 0xffffffffu;
    std::uint32_t resource = kInvalid;
    std::uint32_t version = 0;
    explicit operator bool() const { return resource != kInvalid; }
    bool operator==(const Handle&) const = default;
};
using TextureHandle = Handle<struct TextureTag>;
using BufferHandle = Handle<struct BufferTag>;

enum class Access : std::uint8_t {
    Sampled,         ///< texture() or texelFetch()
    ColorAttachment, ///< write: rasterised into
    DepthAttachment, ///< write: depth-tested and written
    DepthTest,       ///< read: depth-tested, not written; may be sampled as well
    ImageRead,
    ImageWrite,
    UniformRead,
    StorageRead,
    StorageWrite,
    TexelRead, ///< buffer texture
    Download,  ///< read back or copied from
    Upload     ///< write: by the CPU or copied to
};

} // namespace tessera::graph
