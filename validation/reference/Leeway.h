#pragma once
#include "validation/reference/Filtering.h"
#include "validation/reference/Hit.h"
#include "validation/reference/Settings.h"

namespace tessera::reference {

/// How far a program that keeps the definition may stray from it in looking up a texture.
///
/// By the exact definition: the rounding to fp32 of a triangle's corners, the pixel's ray and the texture's
/// transform. By hardware: that OpenGL leaves to the driver how it interpolates coordinates, the digits of its weights,
/// and the level of detail between finestLevelOf() and the sum of both changes; the sum is not granted, or a wrong
/// level would pass. Drivers magnify up to level 0 also where OpenGL says 1/2.
struct Leeway {
    glm::dvec2 texCoord{0.0};          ///< either way
    double finer = 0.0, coarser = 0.0; ///< levels of detail
    double magnifiedFrom = 0.0;        ///< the lowest level of detail up to which a program may magnify
    double codes = 0.0;                ///< of a texel's code values, 0..1
};

Leeway leewayOf(Filtering filtering, const scenes::TextureUse& use, const Footprint& footprint, const Pyramid& pyramid,
                const Hit& hit);

} // namespace tessera::reference
