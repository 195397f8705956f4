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

constexpr int kErrorScaleLowExponent = -7; ///< the scale runs from 1e-7 (half an fp32 step) to 1, in decades
constexpr Rgb8 kColourNotFinite = {255, 0, 255};
constexpr Rgb8 kColourUncovered = {56, 56, 58};
constexpr Rgb8 kColourExcluded = {78, 106, 124};

/// Of sRGB code values 0..1.
Rgb8 codeColour(const glm::vec3& code);

/// Colour of the scale at 0..1 (clamped): heatColor() of shaders/shared/heat.h.
Rgb8 scaleColour(double position);

/// Where a relative error lies on the scale: 0 at 1e-7 and below (0 included), 1 at 1 and above, logarithmic between.
double scalePosition(double rel);

/// Where the picture sits in a heat map, which is enlarged by whole numbers when it is small. The letters grow with the
/// image, so that they can be read where it is shown smaller.
struct HeatMapLayout {
    int width = 0, height = 0;      ///< of the whole image
    int pictureX = 0, pictureY = 0; ///< upper left corner of the picture
    int scale = 1;                  ///< size of one of its pixels
    int legendX = 0, legendY = 0;   ///< upper left corner of the colour bar
    int legendWidth = 0, legendHeight = 0;
    int swatchY = 0;   ///< top of the first row of swatches, which starts at legendX
    int textScale = 2; ///< of the font; lengths of the frame grow with it
};

HeatMapLayout heatMapLayout(int pictureWidth, int pictureHeight, int titleLines = 1);

/// A colour and what it means.
struct Swatch {
    Rgb8 colour;
    std::string meaning;
};

/// The same without a colour bar: no wider than the picture, a short title or the widest swatch needs, and as high as
/// the rows of swatches.
HeatMapLayout paintedMapLayout(int pictureWidth, int pictureHeight, std::span<const Swatch> swatches,
                               int titleLines = 1);

/// A title in lines of a width, in pixels at scale 1, broken between words where they have room; two at most, and what
/// is left over is replaced by an ellipsis.
std::vector<std::string> titleLines(const std::string& title, int room);

/// Whether the map of an error is black in every pixel that it compares.
bool showsNoError(const RadianceFigures& figures);

/// The relative error (PixelErrors::rel) of picture a against the truth b as colours on a logarithmic scale from 1e-7
/// to 1, with the title above and the legend below. Pixels that are not finite are magenta, uncovered ones dark grey,
/// excluded ones grey-blue. `excluded` is as errorFigures() takes it.
DisplayImage errorHeatMap(const Picture& a, const Picture& b, const std::string& title,
                          std::span<const std::uint8_t> excluded = {});

/// What flipErrors() finds between two pictures as shown, as colours on a linear scale from 0 (the same) to 1, with the
/// title above and the legend below.
DisplayImage flipHeatMap(const DisplayImage& a, const DisplayImage& b, const std::string& title);

/// A picture of counts (the views `lights` and `overdraw`) as colours on a logarithmic scale up to the largest, with
/// the title above and the legend below. Uncovered pixels are dark grey.
DisplayImage countHeatMap(const Picture& counts, const std::string& title);

/// A picture of the view `faults`, as the display pass painted it, with a legend; the title gets in front how many
/// pixels of `radiance` are NaN, infinite and negative, each counted once, by the worst of its components.
DisplayImage faultMap(const Picture& radiance, const DisplayImage& painted, const std::string& title);

/// A picture as its display pass painted it, with the title above and the swatches below, in rows.
DisplayImage paintedMap(const DisplayImage& painted, const std::string& title, std::span<const Swatch> swatches);

} // namespace tessera::validation
