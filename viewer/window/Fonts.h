#pragma once
#include <vector>

#include "viewer/window/Letters.h"

namespace tessera::viewer {

/// Puts fonts of the system that have these letters in the place of those that Dear ImGui has, at a height in pixels;
/// its own, of western letters, where none is installed. `ranges` is what the letters are handed over in, and must stay
/// until the next call.
void applyFonts(const Letters& letters, float heightPixels, std::vector<std::uint16_t>& ranges);

} // namespace tessera::viewer
