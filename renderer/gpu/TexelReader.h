#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/Texture.h"

namespace tessera::gpu {

/// Reads single texels without waiting for the GPU.
class TexelReader {
public:
    static constexpr std::size_t kMostTextures = 4;
    static constexpr std::size_t kTexelBytes = 16; ///< of the largest format
    using Texel = std::array<std::byte, kTexelBytes>;

    TexelReader();
    ~TexelReader();
    TexelReader(const TexelReader&) = delete;
    TexelReader& operator=(const TexelReader&) = delete;

    /// Queues a GPU copy of one texel, counted from the lower left, of each texture. Textures are flat, with one
    /// sample. Drops an earlier request that was not taken. The texel must lie in each texture (asserted).
    void request(std::span<const Texture* const> textures, glm::ivec2 texel);
    bool isBusy() const { return fence_ != nullptr; } ///< a request was not taken yet
    /// The raw texels, one per texture, in the order of the request; none until the GPU has copied them.
    std::optional<std::vector<Texel>> take();

private:
    void forget();

    Buffer buffer_;
    std::size_t requested_ = 0;
    void* fence_ = nullptr; ///< GLsync
};

} // namespace tessera::gpu
