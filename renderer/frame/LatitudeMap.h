#pragma once
#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Image.h"

namespace tessera::frame {

/// A picture of all directions in latitude and longitude, as scenes/Environment.h has it: rows from the top, left and
/// right are neighbours, the first and the last row go on.
struct LatitudeMap {
    int width = 0, height = 0; ///< texels
    std::vector<glm::vec4> texels;

    const glm::vec4& at(int x, int y) const;
    /// RGB of a unit direction, between the centres of four texels.
    glm::dvec3 radiance(const glm::dvec3& direction) const;
    /// The cosine to the top at the upper edge of a row.
    double cosineOfRow(int row) const;
    double solidAngle(int row) const; ///< of a texel, sr
};

/// Of an Rgba32Float picture.
LatitudeMap latitudeMapOf(const scenes::Image& picture);
/// The same of scenes::averagedMap().
LatitudeMap coarserMap(const scenes::Image& picture, int mostWidth, int mostHeight);

} // namespace tessera::frame
