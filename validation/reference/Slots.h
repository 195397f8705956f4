#pragma once
#include <vector>

#include "validation/reference/Hit.h"

namespace tessera::reference {

/// The texel of a material's slot at a hit, linear; 1 in every channel where the slot is empty.
glm::dvec4 texelOf(scenes::TextureSlot slot, const Hit& hit, const std::vector<scenes::Image>& images);

} // namespace tessera::reference
