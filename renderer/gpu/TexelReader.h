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

    /// Lets the GPU copy a texel of each flat texture of one sample, counted from the lower left, once it has written
    /// them. What was requested before and not taken is forgotten. The texel must lie in each (asserted).
    void request(std::span<const Texture* const> textures, glm::ivec2 texel);
    bool isBusy() const { return fence_ != nullptr; } ///< something was requested and not taken
    /// The texels as they are stored, a texture each, in the order of the request; none until the GPU has copied them.
    std::optional<std::vector<Texel>> take();

private:
    void forget();

    Buffer buffer_;
    std::size_t requested_ = 0;
    void* fence_ = nullptr; ///< GLsync
};

} // namespace tessera::gpu
