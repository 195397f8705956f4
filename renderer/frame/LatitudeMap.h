#pragma once
#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Image.h"

namespace tessera::frame {

/// An equirectangular map, laid out as in scenes/Environment.h: rows from the top; columns wrap, rows are clamped.
struct LatitudeMap {
    int width = 0, height = 0; ///< texels
    std::vector<glm::vec4> texels;

    const glm::vec4& at(int x, int y) const;
    /// RGB in a unit direction, bilinear between texel centres.
    glm::dvec3 radiance(const glm::dvec3& direction) const;
    /// Cosine of the polar angle at the upper edge of a row.
    double cosineOfRow(int row) const;
    double solidAngle(int row) const; ///< of a texel, sr
};

/// Copies an Rgba32Float image.
LatitudeMap latitudeMapOf(const scenes::Image& picture);
/// The same of scenes::averagedMap(), if the image is larger.
LatitudeMap coarserMap(const scenes::Image& picture, int mostWidth, int mostHeight);

} // namespace tessera::frame
