#pragma once
#include <cmath>
#include <vector>

#include "viewer/window/Letters.h"

namespace tessera::viewer {

/// Font size of titles, such as a view's name, for a font size of text: whole pixels.
inline float titlePixels(float heightPixels) {
    return std::floor(1.8f * heightPixels);
}

/// Replaces the fonts of Dear ImGui by fonts with these letters: one of a height in pixels, and last one for titles.
/// Chinese, Japanese and Korean use a system font, if there is one. `ranges` receives the ranges of letters, and must
/// stay until the next call.
void applyFonts(const Letters& letters, float heightPixels, std::vector<std::uint16_t>& ranges);

} // namespace tessera::viewer
