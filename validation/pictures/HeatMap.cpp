#include "validation/pictures/HeatMap.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/Utf8.h"
#include "shaders/shared/faults.h"
#include "shaders/shared/heat.h"
#include "validation/figures/Flip.h"
#include "validation/figures/PixelErrors.h"

namespace tessera::validation {
namespace {

std::uint8_t codeValue(float value) {
    return std::uint8_t(std::lround(255.0f * value));
}

// Lengths in font pixels, each textScale pixels of the image wide.
constexpr int kMargin = 6;
constexpr int kBarHeight = 8;
constexpr int kTickHeight = 3;
constexpr int kTickGap = 1; // to the label
constexpr int kSwatch = 7;
constexpr int kWordsGap = 3;  // from a swatch to its words
constexpr int kSwatchGap = 8; // from the words to the next swatch
constexpr int kSwatchRow = kLineHeight + kMargin / 2;
constexpr int kLeastWidth = 320;        // fits the swatches with their words, and labels without overlap
constexpr int kLeastPaintedWidth = 160; // fits a title of two lines
constexpr int kLeastTextScale = 2;
constexpr std::size_t kMostTitleLines = 2;
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

/// A position on the scale, 0..1, and its label.
struct Tick {
    double position;
    std::string label;
};

std::vector<Tick> errorTicks() {
    constexpr const char* kRaised[] = {"¹", "²", "³", "⁴", "⁵", "⁶", "⁷"};
    std::vector<Tick> ticks{{1.0, "1"}};
    for (int i = 1; i <= -kErrorScaleLowExponent; ++i)
        ticks.push_back({scalePosition(std::pow(10.0, -i)), fmt::format("10⁻{}", kRaised[i - 1])});
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

float scaleEnd(const Picture& counts) {
    float most = 0.0f;
    for (std::size_t i = 0; i < counts.pixelCount(); ++i) most = std::max(most, counts.pixel(i)[0]);
    return shared::heatScaleLog2(most);
}

/// An empty heat map with its title.
struct Framed {
    HeatMapLayout layout;
    DisplayImage image;
};

/// layoutFor(n) returns the layout for a title of n lines.
template <typename LayoutFor>
Framed framed(const LayoutFor& layoutFor, const std::string& title) {
    HeatMapLayout layout = layoutFor(1);
    const int unit = layout.textScale;
    const std::vector<std::string> lines = titleLines(title, layout.width / unit - 2 * kMargin);
    layout = layoutFor(std::max(int(lines.size()), 1));
    DisplayImage image{layout.width, layout.height, {}};
    image.rgb.resize(3 * image.pixelCount());
    fillRectangle(image, 0, 0, image.width, image.height, kBackground);
    for (std::size_t i = 0; i < lines.size(); ++i)
        drawText(image, unit * kMargin, unit * (kMargin + int(i) * kLineHeight), lines[i], kInk, unit);
    return {layout, std::move(image)};
}

Framed framedWithBar(int pictureWidth, int pictureHeight, const std::string& title) {
    return framed([&](int lines) { return heatMapLayout(pictureWidth, pictureHeight, lines); }, title);
}

void drawPixel(DisplayImage& image, const HeatMapLayout& layout, std::size_t pixel, int width, Rgb8 colour) {
    const int x = int(pixel % std::size_t(width)), y = int(pixel / std::size_t(width));
    fillRectangle(image, layout.pictureX + layout.scale * x, layout.pictureY + layout.scale * y, layout.scale,
                  layout.scale, colour);
}

void drawBar(DisplayImage& image, const HeatMapLayout& layout, const std::vector<Tick>& ticks) {
    const int span = layout.legendWidth - 1, unit = layout.textScale;
    for (int x = 0; x <= span; ++x)
        fillRectangle(image, layout.legendX + x, layout.legendY, 1, layout.legendHeight,
                      scaleColour(double(x) / double(span)));
    const int tickY = layout.legendY + layout.legendHeight;
    for (const Tick& tick : ticks) {
        const int x = layout.legendX + int(std::lround(span * tick.position));
        fillRectangle(image, x, tickY, 1, unit * kTickHeight, kFaintInk);
        const int labelWidth = textWidth(tick.label, unit);
        const int left =
            std::clamp(x - labelWidth / 2, layout.legendX, layout.legendX + layout.legendWidth - labelWidth);
        drawText(image, left, tickY + unit * (kTickHeight + kTickGap), tick.label, kInk, unit);
    }
}

int swatchWidth(const Swatch& swatch) {
    return kSwatch + kWordsGap + textWidth(swatch.meaning);
}

/// Upper left corners in font pixels, in rows of width `room`.
std::vector<glm::ivec2> swatchPlaces(std::span<const Swatch> swatches, int room) {
    std::vector<glm::ivec2> places;
    glm::ivec2 next(0);
    for (const Swatch& swatch : swatches) {
        if (next.x > 0 && next.x + swatchWidth(swatch) > room) next = {0, next.y + kSwatchRow};
        places.push_back(next);
        next.x += swatchWidth(swatch) + kSwatchGap;
    }
    return places;
}

void drawSwatches(DisplayImage& image, const HeatMapLayout& layout, std::span<const Swatch> swatches) {
    const int unit = layout.textScale, side = unit * kSwatch;
    const std::vector<glm::ivec2> places = swatchPlaces(swatches, layout.legendWidth / unit);
    for (std::size_t i = 0; i < swatches.size(); ++i) {
        const int x = layout.legendX + unit * places[i].x, y = layout.swatchY + unit * places[i].y;
        fillRectangle(image, x, y, side, side, kFaintInk);
        fillRectangle(image, x + 1, y + 1, side - 2, side - 2, swatches[i].colour);
        drawText(image, x + side + unit * kWordsGap, y, swatches[i].meaning, kFaintInk, unit);
    }
}

} // namespace

Rgb8 codeColour(const glm::vec3& code) {
    return {codeValue(code.r), codeValue(code.g), codeValue(code.b)};
}

Rgb8 scaleColour(double position) {
    return codeColour(shared::heatColor(float(position)));
}

double scalePosition(double rel) {
    if (!(rel > 0.0)) return 0.0;
    return std::clamp(1.0 - std::log10(rel) / double(kErrorScaleLowExponent), 0.0, 1.0);
}

HeatMapLayout heatMapLayout(int pictureWidth, int pictureHeight, int lines) {
    HeatMapLayout layout;
    // Enlarges small images by a whole factor until the longer side reaches the legend's minimum width.
    const int fits = kLeastTextScale * (kLeastWidth - 2 * kMargin) / std::max(pictureWidth, pictureHeight);
    layout.scale = std::max(1, fits);
    layout.textScale = std::max(kLeastTextScale, layout.scale * pictureWidth / (kLeastWidth - 2 * kMargin));
    const int unit = layout.textScale;
    layout.width = std::max(unit * kLeastWidth, layout.scale * pictureWidth + 2 * unit * kMargin);
    layout.pictureX = (layout.width - layout.scale * pictureWidth) / 2;
    layout.pictureY = unit * (kMargin + lines * kLineHeight + kMargin / 2);
    layout.legendX = unit * kMargin;
    layout.legendY = layout.pictureY + layout.scale * pictureHeight + unit * kMargin;
    layout.legendWidth = layout.width - 2 * unit * kMargin;
    layout.legendHeight = unit * kBarHeight;
    layout.swatchY = layout.legendY + layout.legendHeight + unit * (kTickHeight + kTickGap + kLineHeight + kMargin / 2);
    layout.height = layout.swatchY + unit * (kLineHeight + kMargin);
    return layout;
}

HeatMapLayout paintedMapLayout(int pictureWidth, int pictureHeight, std::span<const Swatch> swatches, int lines) {
    HeatMapLayout layout = heatMapLayout(pictureWidth, pictureHeight, lines);
    const int unit = layout.textScale;
    int least = kLeastPaintedWidth - 2 * kMargin;
    for (const Swatch& swatch : swatches) least = std::max(least, swatchWidth(swatch));
    layout.legendWidth = std::max(layout.scale * pictureWidth, unit * least);
    layout.width = layout.legendWidth + 2 * unit * kMargin;
    layout.pictureX = (layout.width - layout.scale * pictureWidth) / 2;
    layout.legendHeight = 0;
    layout.swatchY = layout.height = layout.legendY;
    if (swatches.empty()) return layout;
    const int lastRow = swatchPlaces(swatches, layout.legendWidth / unit).back().y;
    layout.height = layout.swatchY + unit * (lastRow + kLineHeight + kMargin);
    return layout;
}

std::vector<std::string> titleLines(const std::string& title, int room) {
    constexpr std::string_view kEllipsis = "…";
    const auto fitting = [](std::string_view text, int width) {
        std::size_t bytes = 0;
        while (bytes < text.size()) {
            const std::size_t next = bytes + std::max<std::size_t>(letterBytes(text.substr(bytes)), 1);
            if (textWidth(text.substr(0, next)) > width) break;
            bytes = next;
        }
        return bytes;
    };
    std::vector<std::string> lines;
    std::string_view rest = title;
    while (!rest.empty()) {
        std::size_t bytes = fitting(rest, room);
        if (bytes < rest.size() && lines.size() + 1 == kMostTitleLines) { // the rest is cut off
            bytes = fitting(rest, room - textWidth(kEllipsis));
            lines.push_back(std::string(rest.substr(0, bytes)) += kEllipsis);
            break;
        }
        const std::size_t gap = bytes < rest.size() ? rest.rfind(' ', bytes) : rest.npos;
        if (gap != rest.npos && gap > 0) bytes = gap;
        lines.emplace_back(rest.substr(0, std::max<std::size_t>(bytes, 1)));
        rest.remove_prefix(lines.back().size());
        rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
    }
    return lines;
}

bool showsNoError(const RadianceFigures& figures) {
    return figures.compared > 0 && scalePosition(figures.maxRel) == 0.0 && figures.bad.sum() == 0;
}

DisplayImage errorHeatMap(const Picture& a, const Picture& b, const std::string& title,
                          std::span<const std::uint8_t> excluded) {
    const PixelErrors errors = pixelErrors(a, b, excluded);
    auto [layout, image] = framedWithBar(a.width, a.height, title);
    for (std::size_t i = 0; i < errors.state.size(); ++i)
        drawPixel(image, layout, i, a.width, colourOf(errors.state[i], errors.rel[i]));
    drawBar(image, layout, errorTicks());
    const Swatch swatches[] = {{scaleColour(0.0), "below 10⁻⁷"},
                               {kColourNotFinite, "NaN or Inf"},
                               {kColourUncovered, "not drawn"},
                               {kColourExcluded, "excluded"}};
    drawSwatches(image, layout, swatches);
    return std::move(image);
}

DisplayImage flipHeatMap(const DisplayImage& a, const DisplayImage& b, const std::string& title) {
    const std::vector<float> errors = flipErrors(a, b);
    auto [layout, image] = framedWithBar(a.width, a.height, title);
    for (std::size_t i = 0; i < errors.size(); ++i)
        drawPixel(image, layout, i, a.width, scaleColour(double(errors[i])));
    drawBar(image, layout, shareTicks());
    const Swatch swatches[] = {{scaleColour(0.0), "looks the same"},
                               {scaleColour(1.0), "could not look more different"}};
    drawSwatches(image, layout, swatches);
    return std::move(image);
}

DisplayImage countHeatMap(const Picture& counts, const std::string& title) {
    auto [layout, image] = framedWithBar(counts.width, counts.height, title);
    const float log2Most = scaleEnd(counts);
    for (std::size_t i = 0; i < counts.pixelCount(); ++i) {
        const float position = shared::heatPositionOfCount(counts.pixel(i)[0], log2Most);
        drawPixel(image, layout, i, counts.width, counts.covered[i] ? scaleColour(position) : kColourUncovered);
    }
    drawBar(image, layout, countTicks(log2Most));
    const Swatch swatches[] = {{kColourUncovered, "not drawn"}};
    drawSwatches(image, layout, swatches);
    return std::move(image);
}

DisplayImage faultMap(const Picture& radiance, const DisplayImage& painted, const std::string& title) {
    std::array<std::size_t, FAULT_NAN + 1> pixels{};
    for (std::size_t i = 0; i < radiance.pixelCount(); ++i) {
        int worst = FAULT_NONE;
        for (int c = 0; c < 3; ++c)
            worst = std::max(worst, shared::faultOfBits(std::bit_cast<std::uint32_t>(radiance.pixel(i)[c])));
        ++pixels[std::size_t(worst)];
    }
    const Swatch swatches[] = {{codeColour(shared::faultColor(FAULT_NAN)), "NaN"},
                               {codeColour(shared::faultColor(FAULT_INFINITE)), "infinite"},
                               {codeColour(shared::faultColor(FAULT_NEGATIVE)), "negative"}};
    return paintedMap(painted,
                      fmt::format("{} NaN, {} infinite, {} negative: {}", pixels[FAULT_NAN], pixels[FAULT_INFINITE],
                                  pixels[FAULT_NEGATIVE], title),
                      swatches);
}

DisplayImage paintedMap(const DisplayImage& painted, const std::string& title, std::span<const Swatch> swatches) {
    auto [layout, image] =
        framed([&](int lines) { return paintedMapLayout(painted.width, painted.height, swatches, lines); }, title);
    for (std::size_t i = 0; i < painted.pixelCount(); ++i) {
        const std::uint8_t* rgb = &painted.rgb[3 * i];
        drawPixel(image, layout, i, painted.width, {rgb[0], rgb[1], rgb[2]});
    }
    drawSwatches(image, layout, swatches);
    return std::move(image);
}

} // namespace tessera::validation
