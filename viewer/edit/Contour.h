#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace tessera::viewer {

/// Where a contour goes, in pixels from the picture's upper left, whose side is at 0: a closed one ends where it
/// begins, one that is cut off by the picture's sides ends at those.
using Contour = std::vector<glm::vec2>;

/// Of all contours of a picture together: more would take a frame to draw, and show nothing.
inline constexpr std::size_t kMostContourPoints = 4096;

/// The contours between pixels that are inside and those that are not, rows from the top, smoothed to within a pixel.
/// The longest of them, up to kMostContourPoints points; the very longest is smoothed more where it has more. The
/// picture's own sides are none.
std::vector<Contour> contoursOf(std::span<const std::uint8_t> isInside, glm::ivec2 sizePixels);

} // namespace tessera::viewer
