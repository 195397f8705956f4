#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/glm.hpp>

/// Depths and normals of visible surfaces, the input of light list building. Rows run bottom-up, as in OpenGL.
namespace tessera::culling {

/// The depths at which pixels are shaded: one per pixel, or a range where a pixel shades several surfaces (transparent
/// layers, samples). Reverse-Z; a pixel whose nearest depth is 0 has no surface.
struct DepthPicture {
    std::span<const float> depth; ///< one per pixel; or two: the nearest, and the farthest negated
    bool isRange = false;
};

enum class NormalForm : std::uint8_t {
    Code,       ///< lib/maths/normal_code.glsl, from bit 0
    Octahedral, ///< two coordinates
    Vector      ///< x, y, z in fp32
};

/// Bit layout of a pixel's normal.
struct NormalEncoding {
    NormalForm form = NormalForm::Code;
    unsigned bit = 0, width = 0; ///< octahedral: first bit of the first coordinate, bits per coordinate
};

/// The shading normals of pixels.
struct NormalPicture {
    std::span<const std::uint32_t> words;
    std::size_t wordsAPixel = 2;
    NormalEncoding encoding;
    glm::mat3 cullingFromLighting{1.0f}; ///< rotation
};

/// One depth and one normal per pixel.
struct SurfacePictures {
    std::span<const float> depth; ///< as in DepthPicture
    const NormalPicture& normals;
    std::size_t widthPixels;
};

} // namespace tessera::culling
