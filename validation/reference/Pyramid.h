#pragma once
#include <vector>

#include <glm/glm.hpp>

#include "validation/reference/Texels.h"

namespace tessera::reference {

/// An image and its smaller levels, linear. A level has half the size of the one before, rounded down; its texels are
/// area-weighted means of the texels they cover: the box filter that OpenGL 4.5 core, section 8.14.4, recommends. Alpha
/// and the texels of normal maps are averaged as they are.
class Pyramid {
public:
    /// With `hasLevels` down to a level of one texel, else level 0 alone. The image must outlive the object.
    Pyramid(const scenes::Image& image, Transfer transfer, bool hasLevels);

    const scenes::Image& image() const { return *image_; }
    Transfer transfer() const { return transfer_; }
    int smallestLevel() const { return int(smaller_.size()); }
    glm::ivec2 sizeTexels(int level) const;
    /// `column` and `row` must lie inside.
    glm::dvec4 texel(int level, int column, int row) const;

private:
    struct Level {
        glm::ivec2 sizeTexels;
        std::vector<glm::vec4> texels; ///< single precision: a rounding of 6e-8, for half the memory
    };
    Level halved(int level) const;

    const scenes::Image* image_;
    Transfer transfer_;
    std::vector<Level> smaller_; ///< from level 1
};

} // namespace tessera::reference
