#include "validation/reference/LookupTolerance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tessera::reference {

namespace {

/// A coordinate comes from two products and two sums of numbers that were rounded to single precision.
constexpr double kCoordinateRounding = 4.0 * 0x1p-24;

/// Rasterisers snap corners to a grid of 1/256 of a pixel, which moves the points between them.
constexpr double kSnappedPixels = 1.0 / 256.0;

/// Weights between two texels have eight bits.
constexpr double kWeightTexels = 1.0 / 256.0;

/// One code value: each level rounds its stored texels once more, weights are rounded too, and sRGB decoding errs by
/// less than half of that. OpenGL has no 16-bit sRGB; such images are stored as floats.
double codesOf(const Pyramid& pyramid) {
    switch (pyramid.image().format) {
    case scenes::TexelFormat::Rgba8Unorm:
        return 1.0 / 255.0;
    case scenes::TexelFormat::Rgba16Unorm:
        return pyramid.transfer() == Transfer::Linear ? 1.0 / 65535.0 : 0.0;
    case scenes::TexelFormat::Rgba32Float:
        return 0.0;
    }
    return 0.0;
}

/// Drivers may shorten the blend between two levels and approximate the logarithm. llvmpipe blends in the middle half
/// of their distance, up to 1/4 of a level off, and takes log2 as linear between powers of two, up to 0.09 off.
constexpr double kBlendLevels = 0.35;

glm::dvec2 transformedMagnitudes(const scenes::TextureUse& use, const Footprint& footprint) {
    return glm::abs(glm::dvec2(use.transform.offset)) + glm::abs(footprint.texCoord - glm::dvec2(use.transform.offset));
}

} // namespace

LookupTolerance lookupTolerance(Filtering filtering, const scenes::TextureUse& use, const Footprint& footprint,
                                const Pyramid& pyramid, const Hit& hit) {
    const glm::dvec2 aPixel = glm::abs(footprint.dx) + glm::abs(footprint.dy);
    LookupTolerance tolerance;
    tolerance.texCoord = hit.roundingPixels * aPixel + kCoordinateRounding * transformedMagnitudes(use, footprint);
    tolerance.finer = tolerance.coarser = hit.roundingLevels;
    tolerance.magnifiedFrom = magnifiedUpTo(use.sampler);
    if (filtering == Filtering::Exact) return tolerance;
    tolerance.magnifiedFrom = 0.0;
    tolerance.codes = codesOf(pyramid);
    const glm::ivec2 sizeTexels = pyramid.sizeTexels(0);
    const double level = levelOf(footprint, sizeTexels);
    const double texelOfLevel = std::exp2(std::max(level, 0.0));
    tolerance.texCoord += kSnappedPixels * aPixel + kWeightTexels * texelOfLevel / glm::dvec2(sizeTexels);
    // Drivers take one footprint per block of 2x2 pixels, by differences.
    const double block = 2.0 * hit.perspective * std::numbers::log2e;
    tolerance.coarser += kBlendLevels + block;
    tolerance.finer += kBlendLevels + block;
    // Both are -infinity where the mesh has no coordinates.
    const double finest = finestLevelOf(footprint, sizeTexels);
    if (level > finest) tolerance.finer += level - finest;
    return tolerance;
}

} // namespace tessera::reference
