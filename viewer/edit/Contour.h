#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace tessera::viewer {

/// A contour in pixels from the image's upper left corner: a closed one ends where it begins, one that the image border
/// cuts off ends there.
using Contour = std::vector<glm::vec2>;

/// For all contours of an image together: more would take a frame to draw without showing more.
inline constexpr std::size_t kMostContourPoints = 4096;

/// The contours between inside and outside pixels, rows from the top, simplified to within a pixel. Only the longest
/// are returned, up to kMostContourPoints points; the longest one is simplified further if it has more. The image
/// border is not a contour.
std::vector<Contour> contoursOf(std::span<const std::uint8_t> isInside, glm::ivec2 sizePixels);

} // namespace tessera::viewer
