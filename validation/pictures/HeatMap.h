#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "base/Picture.h"
#include "validation/figures/ErrorFigures.h"
#include "validation/pictures/Lettering.h"

namespace tessera::validation {

constexpr int kErrorScaleLowExponent = -7; ///< the scale runs from 1e-7 (about one fp32 step) to 1, in decades
constexpr Rgb8 kColourNotFinite = {255, 0, 255};
constexpr Rgb8 kColourUncovered = {56, 56, 58};
constexpr Rgb8 kColourExcluded = {78, 106, 124};

/// Converts sRGB code values 0..1 to 8 bits.
Rgb8 codeColour(const glm::vec3& code);

/// Colour of the scale at 0..1 (clamped): heatColor() of shaders/shared/heat.h.
Rgb8 scaleColour(double position);

/// The position of a relative error on the scale: 0 at 1e-7 and below, 1 at 1 and above, logarithmic between.
double scalePosition(double rel);

/// The layout of a heat map. Small images are enlarged by whole factors. The text grows with the image, so that it
/// stays readable when displayed smaller.
struct HeatMapLayout {
    int width = 0, height = 0;      ///< of the whole image
    int pictureX = 0, pictureY = 0; ///< upper left corner of the picture
    int scale = 1;                  ///< image pixels per pixel of the picture
    int legendX = 0, legendY = 0;   ///< upper left corner of the colour bar
    int legendWidth = 0, legendHeight = 0;
    int swatchY = 0;   ///< top of the first row of swatches, which starts at legendX
    int textScale = 2; ///< of the font; the frame's lengths grow with it
};

HeatMapLayout heatMapLayout(int pictureWidth, int pictureHeight, int titleLines = 1);

/// A colour and what it means.
struct Swatch {
    Rgb8 colour;
    std::string meaning;
};

/// The layout of a map without a colour bar: only as wide as the image, a short title and the widest swatch need, and
/// as high as the rows of swatches.
HeatMapLayout paintedMapLayout(int pictureWidth, int pictureHeight, std::span<const Swatch> swatches,
                               int titleLines = 1);

/// Breaks a title into lines of width `room`, in pixels at scale 1, between words where possible. There are at most two
/// lines; an ellipsis replaces the rest.
std::vector<std::string> titleLines(const std::string& title, int room);

/// Whether an error map is black in every pixel that it compares.
bool showsNoError(const RadianceFigures& figures);

/// The relative error (PixelErrors::rel) of image a against the truth b as colours on a logarithmic scale from 1e-7 to
/// 1, with the title above and the legend below. Pixels that are not finite are magenta, uncovered ones dark grey,
/// excluded ones grey-blue. `excluded` is as errorFigures() takes it.
DisplayImage errorHeatMap(const Picture& a, const Picture& b, const std::string& title,
                          std::span<const std::uint8_t> excluded = {});

/// The flipErrors() of two displayed images, as colours on a linear scale from 0 (the same) to 1, with the title above
/// and the legend below.
DisplayImage flipHeatMap(const DisplayImage& a, const DisplayImage& b, const std::string& title);

/// An image of counts (the views `lights` and `overdraw`) as colours on a logarithmic scale up to the largest, with the
/// title above and the legend below. Uncovered pixels are dark grey.
DisplayImage countHeatMap(const Picture& counts, const std::string& title);

/// The display image of the view `faults`, with a legend. The title is prefixed with the numbers of NaN, infinite and
/// negative pixels of `radiance`; a pixel counts once, by its worst component.
DisplayImage faultMap(const Picture& radiance, const DisplayImage& painted, const std::string& title);

/// A display image with the title above and rows of swatches below.
DisplayImage paintedMap(const DisplayImage& painted, const std::string& title, std::span<const Swatch> swatches);

} // namespace tessera::validation
