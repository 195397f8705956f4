#pragma once
#include <cstddef>
#include <cstdint>
#include <variant>

#include "renderer/graph/Format.h"

/// What passes exchange: shapes of textures and buffers, handles that name them, and the ways of using them.
namespace tessera::graph {

/// What the layers of a texture are: one alone, as many as there are, or the six sides of a cube.
enum class Shape : std::uint8_t { Flat, Array, Cube };

struct TextureDesc {
    Format format = Format::Rgba32Float;
    int width = 0;  ///< texels
    int height = 0; ///< texels
    int samples = 1;
    int levels = 1; ///< mip levels, each half as wide and high as the one before
    int layers = 1; ///< of a cube 6: +x, -x, +y, -y, +z, -z
    Shape shape = Shape::Flat;
    bool operator==(const TextureDesc&) const = default;
};

/// Levels of a full mip chain, down to 1 x 1.
int mipLevelsFor(int width, int height);
/// The texture that one level of another is, all its layers.
TextureDesc mipDesc(const TextureDesc& desc, int level);

/// One picture among a texture's levels and layers.
struct Part {
    int level = 0;
    int layer = 0;
    bool operator==(const Part&) const = default;
};

struct BufferDesc {
    std::size_t bytes = 0;
    /// How much it holds differs from frame to frame: its memory is kept and only ever grows. Of 0 bytes, its first
    /// writer says how many once it runs (PassContext::allocate()).
    bool grows = false;
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
    VertexRead,
    IndexRead,
    IndirectRead, ///< the parameters of a draw or a dispatch
    Download,     ///< read back or copied from
    Upload        ///< write: by the CPU or copied to
};

} // namespace tessera::graph
