#include "validation/pictures/Lettering.h"

#include <algorithm>
#include <cmath>
#include <vector>

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb_truetype.h>

#include "base/Utf8.h"
#include "fontAssets.gen.h"

namespace tessera::validation {
namespace {

struct Font {
    stbtt_fontinfo info{};
    int ascent = 0; ///< above the baseline, in font units

    Font() {
        stbtt_InitFont(&info, reinterpret_cast<const unsigned char*>(fontFile().data()), 0);
        stbtt_GetFontVMetrics(&info, &ascent, nullptr, nullptr);
    }
    int glyphOf(std::uint32_t letter) const {
        const int glyph = stbtt_FindGlyphIndex(&info, int(letter));
        return glyph != 0 ? glyph : stbtt_FindGlyphIndex(&info, '?');
    }
    float pixelsPerUnit(int scale) const { return stbtt_ScaleForPixelHeight(&info, float(scale * kLineHeight)); }
};

const Font& font() {
    static const Font kFont;
    return kFont;
}

/// Removes and returns the first code point of a text that is not empty.
std::uint32_t takeLetter(std::string_view& text) {
    const std::size_t bytes = letterBytes(text);
    const auto byte = [&](std::size_t i) { return std::uint32_t(static_cast<unsigned char>(text[i])); };
    std::uint32_t letter = bytes == 0 ? '?' : bytes == 1 ? byte(0) : byte(0) & (0x7fu >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) letter = letter << 6u | (byte(i) & 0x3fu);
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
    return letter;
}

/// Calls place(glyph, units from the left) for each letter. Returns the width of the text in units of the font.
template <typename Place>
int setText(std::string_view text, const Place& place) {
    int x = 0, before = 0;
    while (!text.empty()) {
        const int glyph = font().glyphOf(takeLetter(text));
        int advance = 0;
        if (before != 0) x += stbtt_GetGlyphKernAdvance(&font().info, before, glyph);
        stbtt_GetGlyphHMetrics(&font().info, glyph, &advance, nullptr);
        place(glyph, x);
        x += advance;
        before = glyph;
    }
    return x;
}

std::uint8_t* pixelAt(DisplayImage& image, int x, int y) {
    return &image.rgb[3 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x))];
}

} // namespace

std::string_view fontFile() {
    return lettering::fontAssets().front().text;
}

int textWidth(std::string_view text, int scale) {
    return int(std::ceil(float(setText(text, [](int, int) {})) * font().pixelsPerUnit(scale)));
}

void fillRectangle(DisplayImage& image, int x, int y, int width, int height, Rgb8 colour) {
    const int right = std::min(x + width, image.width), bottom = std::min(y + height, image.height);
    for (int row = std::max(y, 0); row < bottom; ++row)
        for (int column = std::max(x, 0); column < right; ++column) {
            std::uint8_t* to = pixelAt(image, column, row);
            to[0] = colour.r;
            to[1] = colour.g;
            to[2] = colour.b;
        }
}

void drawText(DisplayImage& image, int x, int y, std::string_view text, Rgb8 colour, int scale) {
    const float pixels = font().pixelsPerUnit(scale);
    const int base = y + int(std::lround(pixels * float(font().ascent)));
    std::vector<unsigned char> coverage;
    setText(text, [&](int glyph, int units) {
        const float left = pixels * float(units), whole = std::floor(left);
        int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
        stbtt_GetGlyphBitmapBoxSubpixel(&font().info, glyph, pixels, pixels, left - whole, 0.0f, &x0, &y0, &x1, &y1);
        const int width = x1 - x0, height = y1 - y0;
        coverage.assign(std::size_t(width) * std::size_t(height), 0);
        stbtt_MakeGlyphBitmapSubpixel(&font().info, coverage.data(), width, height, width, pixels, pixels, left - whole,
                                      0.0f, glyph);
        for (int i = 0; i < width * height; ++i) {
            const int column = x + int(whole) + x0 + i % width, row = base + y0 + i / width;
            if (column < 0 || column >= image.width || row < 0 || row >= image.height) continue;
            std::uint8_t* to = pixelAt(image, column, row);
            const int share = coverage[std::size_t(i)];
            const auto blend = [share](std::uint8_t under, std::uint8_t over) {
                return std::uint8_t((under * (255 - share) + over * share + 127) / 255);
            };
            to[0] = blend(to[0], colour.r);
            to[1] = blend(to[1], colour.g);
            to[2] = blend(to[2], colour.b);
        }
    });
}

} // namespace tessera::validation
