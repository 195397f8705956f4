#pragma once
#include <cmath>
#include <vector>

#include "viewer/window/Letters.h"

namespace tessera::viewer {

/// The height of titles, such as a view's name, beside words of a height: whole pixels.
inline float titlePixels(float heightPixels) {
    return std::floor(1.8f * heightPixels);
}

/// Puts fonts that have these letters in the place of those that Dear ImGui has: one of a height in pixels, and last
/// one of titles. Those of Chinese, Japanese and Korean are the system's, where it has any. `ranges` is what the
/// letters are handed over in, and must stay until the next call.
void applyFonts(const Letters& letters, float heightPixels, std::vector<std::uint16_t>& ranges);

} // namespace tessera::viewer
