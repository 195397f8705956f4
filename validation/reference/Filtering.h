#pragma once
#include <glm/glm.hpp>

#include "validation/reference/Pyramid.h"

/// How OpenGL 4.5 (core profile, section 8.14) reads a texture: which level, and which of its texels. A picture with
/// one level only is what --filter exact means.
namespace tessera::reference {

/// What a pixel covers of a texture: the coordinate at its centre, and by how much that changes to the next pixel.
struct Footprint {
    glm::dvec2 texCoord{0.0};
    glm::dvec2 dx{0.0}, dy{0.0};
};

/// The level of detail: log2 of the larger of the footprint's two sides in texels of level 0 (equations 8.6 and 8.8);
/// -infinity where the coordinate does not change.
double levelOf(const Footprint& footprint, glm::ivec2 sizeTexels);

/// The smallest level of detail that OpenGL allows a driver in its place: log2 of the largest change of one coordinate.
double finestLevelOf(const Footprint& footprint, glm::ivec2 sizeTexels);

/// Up to this level of detail, 0 or 1/2, the magnification filter counts (section 8.15).
double magnifiedUpTo(const scenes::Sampler& sampler);

/// Whether a filter takes single texels of a level.
bool takesNearest(scenes::Filter filter);

/// The texel that the sampler makes of a coordinate at a level of detail, linear. Up to `magnified` its magnification
/// filter counts.
glm::dvec4 filtered(const Pyramid& pyramid, const scenes::Sampler& sampler, const glm::dvec2& texCoord, double level,
                    double magnified);

} // namespace tessera::reference
