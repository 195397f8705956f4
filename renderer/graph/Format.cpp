#include "renderer/graph/Format.h"

#include <array>
#include <cassert>
#include <cstddef>

#include "base/EnumTable.h"

namespace tessera::graph {
namespace {

constexpr std::array kFormats{
    FormatInfo{Format::Rgba32Float, "RGBA32F", 4, 16, false, false},
    FormatInfo{Format::Rgba16Float, "RGBA16F", 4, 8, false, false},
    FormatInfo{Format::Rg32Float, "RG32F", 2, 8, false, false},
    FormatInfo{Format::R32Float, "R32F", 1, 4, false, false},
    FormatInfo{Format::Rgba16Unorm, "RGBA16", 4, 8, false, false},
    FormatInfo{Format::Rg16Snorm, "RG16_SNORM", 2, 4, false, false},
    FormatInfo{Format::Rgba8Unorm, "RGBA8", 4, 4, false, false},
    FormatInfo{Format::Srgb8Alpha8, "SRGB8_ALPHA8", 4, 4, false, false},
    FormatInfo{Format::Rgb10A2Unorm, "RGB10_A2", 4, 4, false, false},
    FormatInfo{Format::Rg16Uint, "RG16UI", 2, 4, false, true},
    FormatInfo{Format::Rgba32Uint, "RGBA32UI", 4, 16, false, true},
    FormatInfo{Format::Rg32Uint, "RG32UI", 2, 8, false, true},
    FormatInfo{Format::R32Uint, "R32UI", 1, 4, false, true},
    FormatInfo{Format::R8Uint, "R8UI", 1, 1, false, true},
    FormatInfo{Format::Depth32Float, "D32F", 1, 4, true, false},
};

static_assert(isInOrder(kFormats, &FormatInfo::format, std::size_t(Format::Count)));

} // namespace

const FormatInfo& formatInfo(Format format) {
    assert(format < Format::Count);
    return kFormats[std::size_t(format)];
}

} // namespace tessera::graph
