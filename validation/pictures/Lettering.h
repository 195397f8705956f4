#pragma once
#include <cstdint>
#include <string_view>

#include "base/Picture.h"

namespace tessera::validation {

struct Rgb8 {
    std::uint8_t r = 0, g = 0, b = 0;
    bool operator==(const Rgb8&) const = default;
};

/// The embedded TrueType font of images and the viewer: DejaVu Sans.
std::string_view fontFile();

constexpr int kLineHeight = 9; ///< from one line of text to the next, in pixels at scale 1

/// Width in pixels of a line of UTF-8 text at a scale, rounded up.
int textWidth(std::string_view text, int scale = 1);

/// Draws a line of UTF-8 text with its upper left corner at x, y, clipped to the image. Characters missing in the font
/// are drawn as '?'.
void drawText(DisplayImage& image, int x, int y, std::string_view text, Rgb8 colour, int scale = 1);

void fillRectangle(DisplayImage& image, int x, int y, int width, int height, Rgb8 colour);

} // namespace tessera::validation
