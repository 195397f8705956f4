#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/glm.hpp>

/// What a picture's pixels show, as light lists are built from it. Rows run from the bottom, as OpenGL reads them.
namespace tessera::culling {

/// The depths at which pixels are shaded: one value per pixel, or two when a pixel shades several surfaces (transparent
/// ones, samples). Reverse-Z; a pixel whose nearest depth is 0 has no surface.
struct DepthPicture {
    std::span<const float> depth; ///< one per pixel; or two: the nearest, and the farthest negated
    bool isRange = false;
};

enum class NormalForm : std::uint8_t {
    Code,       ///< lib/maths/normal_code.glsl, from bit 0
    Octahedral, ///< two coordinates
    Vector      ///< x, y, z in fp32
};

/// How a pixel's words hold its normal.
struct NormalEncoding {
    NormalForm form = NormalForm::Code;
    unsigned bit = 0, width = 0; ///< octahedral: where the first coordinate begins, and bits of each of the two
};

/// The normals with which pixels are lit.
struct NormalPicture {
    std::span<const std::uint32_t> words;
    std::size_t wordsAPixel = 2;
    NormalEncoding encoding;
    glm::mat3 cullingFromLighting{1.0f}; ///< rotation
};

/// One depth and one normal a pixel.
struct SurfacePictures {
    std::span<const float> depth; ///< as DepthPicture has it
    const NormalPicture& normals;
    std::size_t widthPixels;
};

} // namespace tessera::culling
