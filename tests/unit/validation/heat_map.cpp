#include "validation/pictures/HeatMap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "tests/unit/validation/Samples.h"
#include "validation/figures/Flip.h"
#include "validation/figures/PixelErrors.h"

namespace tessera::validation {
namespace {

Rgb8 at(const DisplayImage& image, int x, int y) {
    const std::size_t index = 3 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
    return {image.rgb[index], image.rgb[index + 1], image.rgb[index + 2]};
}

Rgb8 pictureColour(const DisplayImage& image, const HeatMapLayout& layout, int x, int y) {
    return at(image, layout.pictureX + layout.scale * x + layout.scale / 2,
              layout.pictureY + layout.scale * y + layout.scale / 2);
}

TEST(ErrorScale, lightnessRisesAlongTheScale) {
    double before = -1.0;
    for (int step = 0; step <= 256; ++step) {
        const Rgb8 colour = scaleColour(step / 256.0);
        const float encoded[3] = {float(colour.r), float(colour.g), float(colour.b)};
        const double luma = luminance(encoded); // of the encoded values: rises with lightness well enough to order by
        EXPECT_GE(luma, before) << "step " << step;
        before = luma;
    }
    EXPECT_EQ(scaleColour(0.0), (Rgb8{0x00, 0x00, 0x04}));
    EXPECT_EQ(scaleColour(1.0), (Rgb8{0xfc, 0xff, 0xa4}));
    EXPECT_EQ(scaleColour(4.0 / 9.0), (Rgb8{0xa5, 0x2c, 0x60}));
    EXPECT_EQ(scaleColour(-1.0), scaleColour(0.0));
    EXPECT_EQ(scaleColour(2.0), scaleColour(1.0));
}

TEST(ErrorScale, aDecadeIsASeventhOfTheScale) {
    EXPECT_EQ(scalePosition(0.0), 0.0);
    EXPECT_EQ(scalePosition(1e-9), 0.0);
    EXPECT_EQ(scalePosition(1e9), 1.0);
    for (int exponent = -7; exponent <= 0; ++exponent) // 1e-12: rounding of log10 and the division
        EXPECT_NEAR(scalePosition(std::pow(10.0, exponent)), (exponent + 7) / 7.0, 1e-12);
}

TEST(HeatMap, everyPixelHasTheColourOfItsErrorOrItsState) {
    Picture b = greyPicture(3, 2, 1.f);
    Picture a = b;
    setPixel(a, 1, {1.f, 2.f, 1.f});
    setPixel(a, 2, {1.f, 1.f, 1.f + 1.f / 1024.f});
    setPixel(a, 3, {std::numeric_limits<float>::quiet_NaN(), 1.f, 1.f});
    a.covered[4] = b.covered[4] = 0;
    const DisplayImage image = errorHeatMap(a, b, "title", std::vector<std::uint8_t>{0, 0, 0, 0, 0, 1});
    const HeatMapLayout layout = heatMapLayout(3, 2);
    ASSERT_TRUE(image.isConsistent());
    EXPECT_EQ(image.width, layout.width);
    EXPECT_EQ(image.height, layout.height);
    EXPECT_EQ(pictureColour(image, layout, 0, 0), scaleColour(0.0));
    EXPECT_EQ(pictureColour(image, layout, 1, 0), scaleColour(1.0));
    EXPECT_EQ(pictureColour(image, layout, 2, 0), scaleColour(1.0 - std::log10(1024.0) / 7.0));
    EXPECT_EQ(pictureColour(image, layout, 0, 1), kColourNotFinite);
    EXPECT_EQ(pictureColour(image, layout, 1, 1), kColourUncovered);
    EXPECT_EQ(pictureColour(image, layout, 2, 1), kColourExcluded);
}

TEST(HeatMap, theLegendIsTheScaleFromEndToEnd) {
    const Picture picture = greyPicture(640, 4, 1.f);
    const DisplayImage image = errorHeatMap(picture, picture, "title");
    const HeatMapLayout layout = heatMapLayout(640, 4);
    for (int x = 0; x < layout.legendWidth; ++x)
        EXPECT_EQ(at(image, layout.legendX + x, layout.legendY + layout.legendHeight - 1),
                  scaleColour(double(x) / (layout.legendWidth - 1)));
}

/// Whether each column has anything drawn in these rows below the colour bar.
std::vector<bool> inkBelow(const DisplayImage& image, int firstRow, int endRow) {
    std::vector<bool> hasInk(std::size_t(image.width));
    for (int y = firstRow; y < endRow; ++y)
        for (int x = 0; x < image.width; ++x)
            if (at(image, x, y) != at(image, 0, 0)) hasInk[std::size_t(x)] = true;
    return hasInk;
}

TEST(HeatMap, theLegendsWordsAreNotCutOffAndItsLabelsStandApart) {
    for (const auto& [width, height] : {std::pair{64, 64}, {560, 4}, {541, 300}, {1, 1}, {1280, 2}}) {
        SCOPED_TRACE(width);
        const Picture picture = greyPicture(width, height, 1.f);
        const DisplayImage shown{width, height, std::vector<std::uint8_t>(3 * picture.pixelCount(), 7)};
        const HeatMapLayout layout = heatMapLayout(width, height);
        const int bottom = layout.legendY + layout.legendHeight;
        for (const DisplayImage& image : {errorHeatMap(picture, picture, "t"), flipHeatMap(shown, shown, "t")}) {
            const std::vector<bool> ink = inkBelow(image, bottom, layout.height);
            EXPECT_EQ(std::find(ink.begin() + layout.legendX + layout.legendWidth, ink.end(), true), ink.end());
        }
        // All labels lie between ticks and swatches, with a gap of a letter's width between two of them.
        const int unit = layout.textScale, tickRows = unit * (3 + 1);
        const std::vector<bool> ink =
            inkBelow(errorHeatMap(picture, picture, "t"), bottom + tickRows, bottom + tickRows + unit * kLineHeight);
        int labels = 0, gap = unit * 6;
        for (const bool hasInk : ink) {
            if (hasInk && gap >= unit * 6) ++labels;
            gap = hasInk ? 0 : gap + 1;
        }
        EXPECT_EQ(labels, 8);
    }
}

TEST(HeatMap, aPictureIsNotShrunkAndItsLayoutHoldsIt) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 700}, {700, 1}, {64, 36}, {641, 359}, {1920, 1080}}) {
        const HeatMapLayout layout = heatMapLayout(width, height);
        EXPECT_GE(layout.scale, 1);
        EXPECT_GE(layout.pictureX, 0);
        EXPECT_LE(layout.pictureX + layout.scale * width, layout.width);
        EXPECT_LE(layout.pictureY + layout.scale * height, layout.legendY);
        EXPECT_LT(layout.legendY + layout.legendHeight, layout.height);
    }
}

TEST(HeatMap, aTitleOfAnyLengthNeverLeavesTheImage) {
    const Picture picture = greyPicture(2, 2, 1.f);
    const DisplayImage image = errorHeatMap(picture, picture, std::string(1000, 'W'));
    EXPECT_EQ(at(image, image.width - 1, 18), at(image, 0, 0));
    EXPECT_TRUE(errorHeatMap(picture, picture, "").isConsistent());
}

TEST(HeatMap, aTitleIsBrokenBetweenWordsAndCutOnlyAfterTheSecondLine) {
    using testing::ElementsAre;
    const auto linesIn = [](const char* title, const char* room) { return titleLines(title, textWidth(room)); };
    EXPECT_THAT(titleLines("", 9), ElementsAre());
    EXPECT_THAT(linesIn("a vs forward", "a vs forward"), ElementsAre("a vs forward"));
    EXPECT_THAT(linesIn("deferred vs forward", "deferred vs for"), ElementsAre("deferred vs", "forward"));
    EXPECT_THAT(linesIn("clustered_deferred", "clustered_de"), ElementsAre("clustered_de", "ferred"));
    EXPECT_THAT(linesIn("one two three four", "three fo"), ElementsAre("one two", "three …"));
    EXPECT_THAT(linesIn("öäüß", "öä"), ElementsAre("öä", "üß"));
    EXPECT_THAT(titleLines("WW", 1), ElementsAre("W", "…")) << "each line has a letter";
    const Picture picture = greyPicture(2, 2, 1.f);
    const DisplayImage one = errorHeatMap(picture, picture, "short"),
                       two = errorHeatMap(picture, picture,
                                          "clustered_deferred, cluster 16, packed, range 0.004 vs "
                                          "the reference of a scene with a long name");
    EXPECT_EQ(two.width, one.width);
    EXPECT_EQ(two.height, one.height + heatMapLayout(2, 2).textScale * kLineHeight);
}

TEST(HeatMap, theLettersGrowWithTheImageThatIsShownSmaller) {
    EXPECT_EQ(heatMapLayout(160, 90).textScale, 2);
    const HeatMapLayout large = heatMapLayout(1280, 720);
    EXPECT_EQ(large.textScale, 4);
    EXPECT_EQ(heatMapLayout(3840, 2160).textScale, 12);
    EXPECT_GE(large.legendX, 4 * 6);
}

TEST(HeatMap, aPaintedPictureIsFramedNoWiderAndNoHigherThanItsSwatchesNeed) {
    const std::vector<Swatch> swatches(6, {{1, 200, 3}, std::string(21, 'n')});
    for (const auto& [width, height] : {std::pair{320, 180}, {960, 540}, {1, 700}, {64, 36}}) {
        SCOPED_TRACE(width);
        const DisplayImage painted{width, height, std::vector<std::uint8_t>(std::size_t(3 * width * height), 7)};
        const DisplayImage image = paintedMap(painted, "title", swatches);
        const HeatMapLayout layout = paintedMapLayout(width, height, swatches);
        ASSERT_TRUE(image.isConsistent());
        EXPECT_EQ(image.width, layout.width);
        EXPECT_EQ(image.height, layout.height);
        EXPECT_GE(layout.swatchY, layout.pictureY + layout.scale * height);
        EXPECT_LE(layout.swatchY, layout.pictureY + layout.scale * height + 6 * layout.textScale) << "an empty band";
        EXPECT_TRUE(width < 300 || image.width == width + 2 * 6 * layout.textScale) << image.width;
        int swatchPixels = 0;
        for (int y = layout.swatchY; y < image.height; ++y)
            for (int x = 0; x < layout.legendX + layout.legendWidth; ++x)
                swatchPixels += at(image, x, y) == swatches[0].colour ? 1 : 0;
        const int side = 7 * layout.textScale - 2;
        EXPECT_EQ(swatchPixels, 6 * side * side);
        for (int y = 0; y < image.height; ++y)
            ASSERT_EQ(at(image, image.width - 1, y), at(image, 0, 0)) << "words reach the edge";
    }
    EXPECT_LT(paintedMapLayout(960, 540, {}).height, paintedMapLayout(960, 540, {{swatches[0]}}).height);
}

TEST(Lettering, lettersHaveTheirShapesAndWidthsAndAreCutOffAtTheEdge) {
    const auto drawn = [](std::string_view text, int scale, int x = 0, int y = 0) {
        DisplayImage image{64, 32, std::vector<std::uint8_t>(3 * 64 * 32, 0)};
        drawText(image, x, y, text, {255, 255, 255}, scale);
        return image;
    };
    const auto ink = [](const DisplayImage& image) {
        double sum = 0.0;
        for (const std::uint8_t value : image.rgb) sum += double(value) / 255.0 / 3.0;
        return sum;
    };
    // A hyphen of DejaVu Sans is 510 by 166 of 2048 units; a line of 2384 is 27 pixels.
    const double pixelsPerUnit = 27.0 / 2384.0;
    EXPECT_NEAR(ink(drawn("-", 3)), 510 * 166 * pixelsPerUnit * pixelsPerUnit, 0.5);
    EXPECT_EQ(textWidth("--", 3), int(std::ceil(2 * 739 * pixelsPerUnit))) << "each is 739 units wide";
    EXPECT_EQ(textWidth(""), 0);
    EXPECT_NEAR(ink(drawn("-", 3, 30, 5)), ink(drawn("-", 3)), 1e-9);
    EXPECT_LT(ink(drawn("W", 3, -9, -9)), ink(drawn("W", 3)));
    EXPECT_EQ(drawn("\x7f", 2).rgb, drawn("?", 2).rgb) << "what the font lacks";
    EXPECT_EQ(drawn("\xff", 2).rgb, drawn("?", 2).rgb) << "what is no UTF-8";
    EXPECT_NE(drawn("ö", 2).rgb, drawn("?", 2).rgb);
}

TEST(HeatMap, aFlipMapShowsThePixelsErrorOnAScaleFromNothingToOne) {
    const DisplayImage black{5, 4, std::vector<std::uint8_t>(60, 0)}, white{5, 4, std::vector<std::uint8_t>(60, 255)};
    const HeatMapLayout layout = heatMapLayout(5, 4);
    const DisplayImage same = flipHeatMap(black, black, "same"), different = flipHeatMap(black, white, "different");
    EXPECT_EQ(pictureColour(same, layout, 2, 2), scaleColour(0.0));
    EXPECT_EQ(pictureColour(different, layout, 2, 2), scaleColour(double(flipErrors(black, white)[12])));
    EXPECT_NE(pictureColour(different, layout, 2, 2), scaleColour(0.0));
    EXPECT_EQ(at(different, layout.legendX, layout.legendY), scaleColour(0.0));
    EXPECT_EQ(at(different, layout.legendX + layout.legendWidth - 1, layout.legendY), scaleColour(1.0));
}

} // namespace
} // namespace tessera::validation
