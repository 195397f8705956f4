#pragma once
#include <vector>

#include "validation/reference/Hit.h"
#include "validation/reference/Textures.h"

namespace tessera::reference {

/// The texel of a material's slot at a hit, linear; 1 in every channel where the slot is empty.
glm::dvec4 texelOf(scenes::TextureSlot slot, const Hit& hit, const Textures& textures);

/// Whether the hit's texture lookups may return other values within their tolerance (`LookupTolerance`): by hardware
/// always, by the exact definition where a `nearest` filter has two texels to choose from, or the level of detail two
/// filters.
bool isUndecided(const Hit& hit, const Textures& textures);

/// The ends of every tolerance. All surfaces of a pixel are nudged alike, as they share the ray.
const std::vector<Nudge>& nudges();

} // namespace tessera::reference
