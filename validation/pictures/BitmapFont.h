#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "base/Picture.h"

namespace tessera::validation {

struct Rgb8 {
    std::uint8_t r = 0, g = 0, b = 0;
    bool operator==(const Rgb8&) const = default;
};

constexpr int kGlyphWidth = 5;
constexpr int kGlyphHeight = 9;  ///< two of them below the base line
constexpr int kGlyphAdvance = 6; ///< from one character to the next

/// Width in pixels of a line of text at a whole-number scale.
int textWidth(std::string_view text, int scale = 1);

/// Draws a line of ASCII text with its upper left corner at x, y; what falls outside the image is cut off. A character
/// the font lacks is drawn as '?'.
void drawText(DisplayImage& image, int x, int y, std::string_view text, Rgb8 colour, int scale = 1);

void fillRectangle(DisplayImage& image, int x, int y, int width, int height, Rgb8 colour);

} // namespace tessera::validation
