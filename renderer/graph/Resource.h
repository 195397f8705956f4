#pragma once
#include <cstddef>
#include <cstdint>
#include <variant>

#include "renderer/graph/Format.h"

/// Resources that passes exchange: descriptions of textures and buffers, handles, and kinds of access.
namespace tessera::graph {

/// The layers of a texture: a single one, an array, or the six faces of a cube.
enum class Shape : std::uint8_t { Flat, Array, Cube };

struct TextureDesc {
    Format format = Format::Rgba32Float;
    int width = 0;  ///< texels
    int height = 0; ///< texels
    int samples = 1;
    int levels = 1; ///< mip levels, each half as wide and high as the one before
    int layers = 1; ///< 6 for a cube: +x, -x, +y, -y, +z, -z
    Shape shape = Shape::Flat;
    bool operator==(const TextureDesc&) const = default;
};

/// Levels of a full mip chain, down to 1 x 1.
int mipLevelsFor(int width, int height);
/// Description of one mip level, with all its layers.
TextureDesc mipDesc(const TextureDesc& desc, int level);

/// A subresource: one level and layer of a texture.
struct Part {
    int level = 0;
    int layer = 0;
    bool operator==(const Part&) const = default;
};

struct BufferDesc {
    std::size_t bytes = 0;
    /// The size varies from frame to frame: memory is kept across frames and only grows. If `bytes` is 0, the first
    /// writer sets the size at execution (PassContext::allocate()).
    bool grows = false;
    bool operator==(const BufferDesc&) const = default;
};

using ResourceDesc = std::variant<TextureDesc, BufferDesc>;
std::size_t descBytes(const ResourceDesc& desc);

/// Refers to one version of a resource: writing returns a new version, and the old handle becomes stale.
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
    VertexRead,
    IndexRead,
    IndirectRead, ///< the parameters of a draw or a dispatch
    Download,     ///< read back or copied from
    Upload        ///< write: by the CPU or copied to
};

} // namespace tessera::graph
