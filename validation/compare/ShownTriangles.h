#pragma once
#include <cstdint>
#include <vector>

#include "engine/Renderer.h"
#include "validation/figures/LostGeometry.h"
#include "validation/reference/Render.h"

/// Whether the GPU shows the triangles that the reference's rays meet, pixel by pixel.
namespace tessera::validation {

struct ShownTriangles {
    /// By pixel, 1 where the two show different triangles and rounding explains it: such pixels are not compared.
    std::vector<std::uint8_t> excluded;
    std::vector<LostGeometry> lost; ///< all other differences, most pixels first
};

/// How far a rasteriser may move an edge, in pixels: vertices are rounded to 1/256, so by up to 1/512 along each axis
/// (OpenGL 4.5 core, GL_SUBPIXEL_BITS, 8 on today's drivers); the rest is for fp32's rounding of the vertices before.
inline constexpr double kEdgeShiftPixels = 1.0 / 128.0;

/// A pixel whose triangles differ is excluded when
/// - rays no farther than kEdgeShiftPixels from its centre meet other triangles than the one through the centre, and
/// - one of them meets just what the GPU shows; or triangles are too small for that: then an id edge of the GPU's
///   picture runs beside the pixel (one of the eight neighbours differs), one of the rays meets the opaque instance
///   that the GPU shows, or each of the two shows the other's opaque instance in a neighbour, and transparent surfaces
///   are the same or differ among the rays.
/// Where one of the rays meets a mask whose opacity lies on either side of its cutoff within what is left open of its
/// texture, the surface with the hole and without it both count as met. Of several triangles in one place any may be
/// shown: the reference has the radiance of each, and the pixel is compared.
/// Draws the view `ids`, which is the same for every technique. `ids`: of the reference's picture of these settings.
ShownTriangles shownTriangles(engine::Renderer& renderer, const frame::FrameSettings& settings,
                              const std::vector<reference::Ids>& ids);

} // namespace tessera::validation
