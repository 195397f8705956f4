#include "validation/pictures/HeatMap.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "shaders/shared/faults.h"
#include "shaders/shared/heat.h"
#include "validation/figures/Flip.h"
#include "validation/figures/PixelErrors.h"

namespace tessera::validation {
namespace {

std::uint8_t codeValue(float value) {
    return std::uint8_t(std::lround(255.0f * value));
}

constexpr int kTextScale = 2;
constexpr int kTextHeight = kTextScale * kGlyphHeight;
constexpr int kMargin = 12;
constexpr int kLeastWidth = 640; // the width of the swatches with their words, and of labels that do not overlap
constexpr int kBarHeight = 16;
constexpr int kTickHeight = 5;
constexpr int kSwatch = 14;
constexpr Rgb8 kBackground = {24, 24, 26};
constexpr Rgb8 kInk = {232, 230, 224};
constexpr Rgb8 kFaintInk = {168, 166, 160};

Rgb8 colourOf(PixelState state, double rel) {
    switch (state) {
    case PixelState::NotFinite:
        return kColourNotFinite;
    case PixelState::Uncovered:
        return kColourUncovered;
    case PixelState::Excluded:
        return kColourExcluded;
    case PixelState::Compared:
        break;
    }
    return scaleColour(scalePosition(rel));
}

/// Shortens text to the available width, its end replaced by dots.
std::string fitted(const std::string& text, int width) {
    const std::size_t fits = std::size_t(std::max(width, 0) / (kTextScale * kGlyphAdvance));
    if (text.size() <= fits) return text;
    return fits < 3 ? std::string() : text.substr(0, fits - 2) + "..";
}

/// A position on the scale, 0..1, and its label.
struct Tick {
    double position;
    std::string label;
};

std::vector<Tick> errorTicks() {
    std::vector<Tick> ticks;
    for (int exponent = kErrorScaleLowExponent; exponent <= 0; ++exponent)
        ticks.push_back({scalePosition(std::pow(10.0, exponent)), exponent == 0 ? "1" : fmt::format("1e{}", exponent)});
    return ticks;
}

std::vector<Tick> shareTicks() {
    std::vector<Tick> ticks;
    for (int fifth = 0; fifth <= 5; ++fifth) ticks.push_back({fifth / 5.0, fmt::format("{:g}", fifth / 5.0)});
    return ticks;
}

std::vector<Tick> countTicks(float log2Most) {
    std::vector<Tick> ticks{{0.0, "0"}};
    for (float count = 1.0f; shared::heatPositionOfCount(count, log2Most) <= 1.0f; count *= 2.0f)
        ticks.push_back({shared::heatPositionOfCount(count, log2Most), fmt::format("{:.0f}", count)});
    return ticks;
}

/// The scale reaches the picture's largest count, and tells at least 0 to 7 apart.
float scaleEnd(const Picture& counts) {
    float most = 7.0f;
    for (std::size_t i = 0; i < counts.pixelCount(); ++i) most = std::max(most, counts.pixel(i)[0]);
    return std::log2(1.0f + most);
}

/// An empty heat map with its title.
DisplayImage framed(const HeatMapLayout& layout, const std::string& title) {
    DisplayImage image{layout.width, layout.height, {}};
    image.rgb.resize(3 * image.pixelCount());
    fillRectangle(image, 0, 0, image.width, image.height, kBackground);
    drawText(image, kMargin, kMargin, fitted(title, image.width - 2 * kMargin), kInk, kTextScale);
    return image;
}

void drawPixel(DisplayImage& image, const HeatMapLayout& layout, std::size_t pixel, int width, Rgb8 colour) {
    const int x = int(pixel % std::size_t(width)), y = int(pixel / std::size_t(width));
    fillRectangle(image, layout.pictureX + layout.scale * x, layout.pictureY + layout.scale * y, layout.scale,
                  layout.scale, colour);
}

void drawBar(DisplayImage& image, const HeatMapLayout& layout, const std::vector<Tick>& ticks) {
    const int span = layout.legendWidth - 1;
    for (int x = 0; x <= span; ++x)
        fillRectangle(image, layout.legendX + x, layout.legendY, 1, layout.legendHeight,
                      scaleColour(double(x) / double(span)));
    const int tickY = layout.legendY + layout.legendHeight;
    for (const Tick& tick : ticks) {
        const int x = layout.legendX + int(std::lround(span * tick.position));
        fillRectangle(image, x, tickY, 1, kTickHeight, kFaintInk);
        const int labelWidth = textWidth(tick.label, kTextScale);
        const int left =
            std::clamp(x - labelWidth / 2, layout.legendX, layout.legendX + layout.legendWidth - labelWidth);
        drawText(image, left, tickY + kTickHeight + 3, tick.label, kInk, kTextScale);
    }
}

struct Swatch {
    Rgb8 colour;
    const char* meaning;
};

void drawSwatches(DisplayImage& image, const HeatMapLayout& layout, std::span<const Swatch> swatches) {
    int x = layout.legendX;
    const int y = layout.legendY + kBarHeight + kTickHeight + 3 + kTextHeight + kMargin / 2;
    for (const Swatch& swatch : swatches) {
        fillRectangle(image, x, y, kSwatch, kSwatch, kFaintInk);
        fillRectangle(image, x + 1, y + 1, kSwatch - 2, kSwatch - 2, swatch.colour);
        x += kSwatch + 6;
        drawText(image, x, y, swatch.meaning, kFaintInk, kTextScale);
        x += textWidth(swatch.meaning, kTextScale) + 16;
    }
}

} // namespace

Rgb8 scaleColour(double position) {
    const glm::vec3 color = shared::heatColor(float(position));
    return {codeValue(color.r), codeValue(color.g), codeValue(color.b)};
}

double scalePosition(double rel) {
    if (!(rel > 0.0)) return 0.0;
    return std::clamp(1.0 - std::log10(rel) / double(kErrorScaleLowExponent), 0.0, 1.0);
}

HeatMapLayout heatMapLayout(int pictureWidth, int pictureHeight) {
    HeatMapLayout layout;
    // A picture of a few pixels is enlarged, but never to more than the height that the legend's width suggests.
    const int fits = (kLeastWidth - 2 * kMargin) / std::max(pictureWidth, pictureHeight);
    layout.scale = std::max(1, fits);
    layout.width = std::max(kLeastWidth, layout.scale * pictureWidth + 2 * kMargin);
    layout.pictureX = (layout.width - layout.scale * pictureWidth) / 2;
    layout.pictureY = kMargin + kTextHeight + kMargin / 2;
    layout.legendX = kMargin;
    layout.legendY = layout.pictureY + layout.scale * pictureHeight + kMargin;
    layout.legendWidth = layout.width - 2 * kMargin;
    layout.legendHeight = kBarHeight;
    layout.height = layout.legendY + kBarHeight + kTickHeight + 3 + kTextHeight + kMargin / 2 + kTextHeight + kMargin;
    return layout;
}

DisplayImage errorHeatMap(const Picture& a, const Picture& b, const std::string& title,
                          std::span<const std::uint8_t> excluded) {
    const PixelErrors errors = pixelErrors(a, b, excluded);
    const HeatMapLayout layout = heatMapLayout(a.width, a.height);
    DisplayImage image = framed(layout, title);
    for (std::size_t i = 0; i < errors.state.size(); ++i)
        drawPixel(image, layout, i, a.width, colourOf(errors.state[i], errors.rel[i]));
    drawBar(image, layout, errorTicks());
    const Swatch swatches[] = {{scaleColour(0.0), "below 1e-7"},
                               {kColourNotFinite, "NaN or Inf"},
                               {kColourUncovered, "not drawn"},
                               {kColourExcluded, "excluded"}};
    drawSwatches(image, layout, swatches);
    return image;
}

DisplayImage flipHeatMap(const DisplayImage& a, const DisplayImage& b, const std::string& title) {
    const std::vector<float> errors = flipErrors(a, b);
    const HeatMapLayout layout = heatMapLayout(a.width, a.height);
    DisplayImage image = framed(layout, title);
    for (std::size_t i = 0; i < errors.size(); ++i)
        drawPixel(image, layout, i, a.width, scaleColour(double(errors[i])));
    drawBar(image, layout, shareTicks());
    const Swatch swatches[] = {{scaleColour(0.0), "looks the same"},
                               {scaleColour(1.0), "could not look more different"}};
    drawSwatches(image, layout, swatches);
    return image;
}

DisplayImage countHeatMap(const Picture& counts, const std::string& title) {
    const HeatMapLayout layout = heatMapLayout(counts.width, counts.height);
    DisplayImage image = framed(layout, title);
    const float log2Most = scaleEnd(counts);
    for (std::size_t i = 0; i < counts.pixelCount(); ++i) {
        const float position = shared::heatPositionOfCount(counts.pixel(i)[0], log2Most);
        drawPixel(image, layout, i, counts.width, counts.covered[i] ? scaleColour(position) : kColourUncovered);
    }
    drawBar(image, layout, countTicks(log2Most));
    const Swatch swatches[] = {{kColourUncovered, "not drawn"}};
    drawSwatches(image, layout, swatches);
    return image;
}

DisplayImage faultMap(const Picture& radiance, const DisplayImage& painted, const std::string& title) {
    std::array<std::size_t, FAULT_NAN + 1> pixels{};
    for (std::size_t i = 0; i < radiance.pixelCount(); ++i) {
        int worst = FAULT_NONE;
        for (int c = 0; c < 3; ++c)
            worst = std::max(worst, shared::faultOfBits(std::bit_cast<std::uint32_t>(radiance.pixel(i)[c])));
        ++pixels[std::size_t(worst)];
    }
    const HeatMapLayout layout = heatMapLayout(painted.width, painted.height);
    DisplayImage image = framed(layout, fmt::format("{} NaN, {} infinite, {} negative: {}", pixels[FAULT_NAN],
                                                    pixels[FAULT_INFINITE], pixels[FAULT_NEGATIVE], title));
    for (std::size_t i = 0; i < painted.pixelCount(); ++i) {
        const std::uint8_t* rgb = &painted.rgb[3 * i];
        drawPixel(image, layout, i, painted.width, {rgb[0], rgb[1], rgb[2]});
    }
    const auto colourOfFault = [](int fault) {
        const glm::vec3 code = shared::faultColor(fault) * 255.0f;
        return Rgb8{std::uint8_t(code.r), std::uint8_t(code.g), std::uint8_t(code.b)};
    };
    const Swatch swatches[] = {{colourOfFault(FAULT_NAN), "NaN"},
                               {colourOfFault(FAULT_INFINITE), "infinite"},
                               {colourOfFault(FAULT_NEGATIVE), "negative"}};
    drawSwatches(image, layout, swatches);
    return image;
}

} // namespace tessera::validation
