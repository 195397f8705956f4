#pragma once
#include <cstdint>
#include <string_view>

namespace tessera::graph {

/// Texel formats of textures that passes exchange; the table behind formatInfo() is the only list of them.
enum class Format : std::uint8_t {
    Rgba32Float,
    Rgba16Float,
    Rg32Float,
    R32Float,
    Rgba16Unorm,
    Rg16Snorm,
    Rgba8Unorm,
    Srgb8Alpha8,
    Rgb10A2Unorm,
    Rg16Uint,
    Rgba32Uint,
    Rg32Uint,
    R32Uint,
    R8Uint,
    Depth32Float,
    Count
};

struct FormatInfo {
    Format format;
    std::string_view name; ///< as in plans and documentation, e.g. "RGBA32F"
    int components;
    int bytes; ///< per texel
    bool depth;
    bool integer;
};

const FormatInfo& formatInfo(Format format);

} // namespace tessera::graph
