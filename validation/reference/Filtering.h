#pragma once
#include <glm/glm.hpp>

#include "validation/reference/Pyramid.h"

/// Texture filtering by OpenGL 4.5 (core profile, section 8.14): the choice of levels and of their texels. --filter
/// exact is the case of an image with level 0 alone.
namespace tessera::reference {

/// A pixel's footprint in a texture: the coordinate at its centre, and its change to the next pixel.
struct Footprint {
    glm::dvec2 texCoord{0.0};
    glm::dvec2 dx{0.0}, dy{0.0};
};

/// The level of detail: log2 of the larger of the footprint's two sides in texels of level 0 (equations 8.6 and 8.8);
/// -infinity where the coordinate does not change.
double levelOf(const Footprint& footprint, glm::ivec2 sizeTexels);

/// The smallest level of detail that OpenGL allows a driver instead: log2 of the largest change of one coordinate.
double finestLevelOf(const Footprint& footprint, glm::ivec2 sizeTexels);

/// The level of detail, 0 or 1/2, up to which the magnification filter applies (section 8.15).
double magnifiedUpTo(const scenes::Sampler& sampler);

/// Whether a filter takes the nearest texel of a level.
bool usesNearest(scenes::Filter filter);

/// Samples an image with a sampler at a level of detail; linear. The magnification filter applies up to `magnified`.
glm::dvec4 filtered(const Pyramid& pyramid, const scenes::Sampler& sampler, const glm::dvec2& texCoord, double level,
                    double magnified);

} // namespace tessera::reference
