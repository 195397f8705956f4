#pragma once
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Image.h"

namespace tessera::viewer {

/// A stored texel, of integer formats from 0 to 1.
glm::vec4 texelOf(const scenes::Image& image, int x, int y);

/// A small copy of an image, rows from the top, with its stored values.
struct Thumbnail {
    glm::ivec2 sizePixels{0};
    std::vector<glm::u8vec4> pixels;
};

/// A thumbnail whose longer side has at most `mostPixels`. Each pixel is the mean of some of the texels that it covers.
Thumbnail thumbnailOf(const scenes::Image& image, int mostPixels);

} // namespace tessera::viewer
