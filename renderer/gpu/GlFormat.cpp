#include "renderer/gpu/GlFormat.h"

#include <array>
#include <cassert>
#include <cstddef>

#include <glad/gl.h>

#include "base/EnumTable.h"

namespace tessera::gpu {
namespace {

using graph::Format;

constexpr std::array kFormats{
    GlFormat{Format::Rgba32Float, GL_RGBA32F, GL_RGBA, GL_FLOAT, true, true},
    GlFormat{Format::Rgba16Float, GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, true, true},
    GlFormat{Format::Rg32Float, GL_RG32F, GL_RG, GL_FLOAT, true, true},
    GlFormat{Format::R32Float, GL_R32F, GL_RED, GL_FLOAT, true, true},
    GlFormat{Format::Rgba16Unorm, GL_RGBA16, GL_RGBA, GL_UNSIGNED_SHORT, true, true},
    GlFormat{Format::Rg16Snorm, GL_RG16_SNORM, GL_RG, GL_SHORT, false, true},
    GlFormat{Format::Rgba8Unorm, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, true, true},
    GlFormat{Format::Srgb8Alpha8, GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, false, false},
    GlFormat{Format::Rgb10A2Unorm, GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, false, true},
    GlFormat{Format::Rg16Uint, GL_RG16UI, GL_RG_INTEGER, GL_UNSIGNED_SHORT, true, true},
    GlFormat{Format::Rgba32Uint, GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, true, true},
    GlFormat{Format::Rg32Uint, GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, true, true},
    GlFormat{Format::R32Uint, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, true, true},
    GlFormat{Format::R8Uint, GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, true, true},
    GlFormat{Format::Depth32Float, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, false, false},
};

static_assert(isInOrder(kFormats, &GlFormat::format, std::size_t(Format::Count)));

} // namespace

const GlFormat& glFormat(graph::Format format) {
    assert(format < Format::Count);
    return kFormats[std::size_t(format)];
}

} // namespace tessera::gpu
