#pragma once
#include <cstdint>
#include <string_view>

#include "base/Picture.h"

namespace tessera::validation {

struct Rgb8 {
    std::uint8_t r = 0, g = 0, b = 0;
    bool operator==(const Rgb8&) const = default;
};

/// The TrueType file of the letters, in pictures and in the viewer: DejaVu Sans, which the program carries.
std::string_view fontFile();

constexpr int kLineHeight = 9; ///< from one line of text to the next, in pixels at scale 1

/// Width in pixels of a line of UTF-8 text at a scale, rounded up.
int textWidth(std::string_view text, int scale = 1);

/// Draws a line of UTF-8 text with its upper left corner at x, y; what falls outside the image is cut off. What the
/// font lacks is drawn as '?'.
void drawText(DisplayImage& image, int x, int y, std::string_view text, Rgb8 colour, int scale = 1);

void fillRectangle(DisplayImage& image, int x, int y, int width, int height, Rgb8 colour);

} // namespace tessera::validation
