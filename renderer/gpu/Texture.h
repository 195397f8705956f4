#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <ranges>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/gpu/Id.h"
#include "renderer/graph/Graph.h"

namespace tessera::gpu {

/// A texture of immutable storage: flat, an array or a cube; samples > 1 makes it multisampled (flat, one level, no
/// upload, no download). Made with nearest filtering and clamped edges, as texelFetch and the G-buffer need;
/// a Sampler overrides both.
class Texture {
public:
    /// Throws std::runtime_error naming label, size and format if size or samples exceed the driver's limits or memory
    /// runs out. Contents are undefined until written.
    Texture(std::string label, const graph::TextureDesc& desc);
    ~Texture();
    Texture(Texture&&) noexcept = default;
    Texture& operator=(Texture&&) noexcept = default;

    /// Replaces one level of a layer. Rows tightly packed, in GL order: the first row is the one sampled at v = 0.
    void upload(int level, std::span<const std::byte> texels, int layer = 0) const;
    template <std::ranges::contiguous_range Range>
    requires(!std::convertible_to<Range, std::span<const std::byte>>) void upload(int level, const Range& texels,
                                                                                  int layer = 0) const {
        upload(level, std::as_bytes(std::span(std::ranges::data(texels), std::ranges::size(texels))), layer);
    }
    /// Fills all levels with 0.
    void clear() const;
    /// Fills levels 1.. from level 0 by the driver's box filter.
    void generateMips() const;

    /// One level's texels of a layer, tightly packed, rows in GL order (lower-left first for rendered images); waits
    /// for the GPU.
    std::vector<std::byte> downloadBytes(int level = 0, int layer = 0) const;
    /// The same into memory of levelBytes(level).
    void downloadInto(int level, std::span<std::byte> texels, int layer = 0) const;
    template <typename T>
    std::vector<T> downloadAs(int level = 0, int layer = 0) const {
        static_assert(std::is_trivially_copyable_v<T>);
        std::vector<T> values(levelBytes(level) / sizeof(T));
        downloadInto(level, std::as_writable_bytes(std::span(values)), layer);
        return values;
    }

    /// The same as four 32-bit components per texel; missing ones are (0, 0, 0, 1). Integer formats give unsigned
    /// integers, others the bits of floats.
    std::vector<glm::uvec4> downloadComponents(int level = 0, int layer = 0) const;

    const graph::TextureDesc& desc() const { return desc_; }
    std::size_t levelBytes(int level) const; ///< of one layer
    std::uint32_t id() const { return id_.value(); }
    const std::string& label() const { return label_; }

    /// Unique among all textures ever made, unlike GL names, which are reused. Expires with the texture.
    const std::shared_ptr<const std::uint64_t>& serial() const { return serial_; }

private:
    /// Reads a level as these GLenum values.
    void readLevel(std::uint32_t transferFormat, std::uint32_t transferType, int level, std::span<std::byte> texels,
                   int layer) const;

    std::string label_;
    graph::TextureDesc desc_;
    std::shared_ptr<const std::uint64_t> serial_;
    Id id_;
};

} // namespace tessera::gpu
