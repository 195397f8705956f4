#pragma once
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Image.h"

namespace tessera::viewer {

/// A small copy of a picture, rows from the top, with its values as they are stored.
struct Thumbnail {
    glm::ivec2 sizePixels{0};
    std::vector<glm::u8vec4> pixels;
};

/// One whose longer side is that many pixels at most. Each is the mean of some of the texels that it covers.
Thumbnail thumbnailOf(const scenes::Image& image, int mostPixels);

} // namespace tessera::viewer
