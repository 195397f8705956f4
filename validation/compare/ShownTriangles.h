#pragma once
#include <cstdint>
#include <vector>

#include "engine/Renderer.h"
#include "validation/figures/LostGeometry.h"
#include "validation/reference/Render.h"

/// Compares the triangles that the GPU shows with those that the reference's rays hit, per pixel.
namespace tessera::validation {

struct ShownTriangles {
    /// Per pixel, 1 where the two show different triangles and rounding explains it: such pixels are not compared.
    std::vector<std::uint8_t> excluded;
    std::vector<LostGeometry> lost; ///< all other differences, most pixels first
};

/// How far a rasteriser may move an edge, in pixels: vertices are rounded to 1/256, so by up to 1/512 along each axis
/// (OpenGL 4.5 core, GL_SUBPIXEL_BITS, 8 on today's drivers); the rest is for earlier fp32 rounding of the vertices.
inline constexpr double kEdgeShiftPixels = 1.0 / 128.0;

/// A pixel whose triangles differ is excluded when
/// - rays no farther than kEdgeShiftPixels from its centre hit other triangles than the one through the centre, and
/// - one of them hits exactly what the GPU shows. For triangles too small for that: an id edge of the GPU's image runs
///   beside the pixel (one of the eight neighbours differs), a ray hits the opaque instance that the GPU shows or each
///   image shows the other's opaque instance in a neighbour, and transparent surfaces are equal or differ among the
///   rays.
/// A mask whose opacity equals its cutoff within the tolerance of its texture counts as hit both with and without the
/// hole. Any of several coincident triangles may be shown: the reference has the radiance of each, and the pixel is
/// compared.
/// Draws the view `ids`, which is the same for every technique. `ids`: of the reference's image with these settings.
ShownTriangles shownTriangles(engine::Renderer& renderer, const frame::FrameSettings& settings,
                              const std::vector<reference::Ids>& ids);

} // namespace tessera::validation
