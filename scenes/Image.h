#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tessera::scenes {

enum class TexelFormat : std::uint8_t { Rgba8Unorm, Rgba16Unorm, Rgba32Float };

/// Decoded image: 4 channels, rows from the top, texels as stored in the file (no transfer function applied).
struct Image {
    std::string name;
    TexelFormat format = TexelFormat::Rgba8Unorm;
    int width = 0;  ///< texels
    int height = 0; ///< texels
    std::vector<std::byte> texels;
};

/// Bytes per texel.
std::size_t texelBytes(TexelFormat format);

} // namespace tessera::scenes
