#pragma once
#include "validation/reference/Filtering.h"
#include "validation/reference/Hit.h"
#include "validation/reference/Settings.h"

namespace tessera::reference {

/// Tolerance of a conforming texture lookup.
///
/// Filtering::Exact: the rounding to fp32 of a triangle's corners, the pixel's ray and the texture's transform.
/// Filtering::Hardware: also what OpenGL leaves to the driver: the interpolation of coordinates, the digits of its
/// weights, and the level of detail between finestLevelOf() and the sum of both changes. The sum is not allowed here,
/// or a wrong level would pass. Drivers magnify up to level 0 also where OpenGL says 1/2.
struct LookupTolerance {
    glm::dvec2 texCoord{0.0};          ///< in either direction
    double finer = 0.0, coarser = 0.0; ///< levels of detail
    double magnifiedFrom = 0.0;        ///< the lowest level of detail up to which a program may magnify
    double codes = 0.0;                ///< of a texel's code values, 0..1
};

LookupTolerance lookupTolerance(Filtering filtering, const scenes::TextureUse& use, const Footprint& footprint,
                                const Pyramid& pyramid, const Hit& hit);

} // namespace tessera::reference
