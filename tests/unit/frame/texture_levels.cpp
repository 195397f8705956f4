#include "renderer/frame/TextureLevels.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

namespace tessera::frame {
namespace {

using scenes::Image;
using scenes::TexelFormat;

/// Grey values by column, the same in every row; alpha 1.
Image columnsOf(const std::vector<float>& values, int height) {
    Image image;
    image.width = int(values.size());
    image.height = height;
    image.format = TexelFormat::Rgba32Float;
    for (int y = 0; y < height; ++y) {
        for (const float value : values) {
            const float texel[] = {value, value, value, 1.0f};
            const auto* bytes = reinterpret_cast<const std::byte*>(texel);
            image.texels.insert(image.texels.end(), bytes, bytes + sizeof texel);
        }
    }
    return image;
}

float redAt(const std::vector<std::byte>& floats, std::size_t texel) {
    float red = 0.0f;
    std::memcpy(&red, floats.data() + texel * 4 * sizeof red, sizeof red);
    return red;
}

TEST(TextureLevels, aTexelIsTheMeanOfTheAreaThatItCovers) {
    // Three texels to one: a third each. Five to two: 2.5 each, then the mean of both.
    EXPECT_FLOAT_EQ(redAt(smallerLevels(columnsOf({1, 2, 6}, 3), false).at(0), 0), 3.0f);
    const auto levels = smallerLevels(columnsOf({1, 2, 4, 8, 16}, 1), false);
    ASSERT_EQ(levels.size(), 2u);
    EXPECT_FLOAT_EQ(redAt(levels[0], 0), (1 + 2 + 0.5f * 4) / 2.5f);
    EXPECT_FLOAT_EQ(redAt(levels[0], 1), (0.5f * 4 + 8 + 16) / 2.5f);
    EXPECT_FLOAT_EQ(redAt(levels[1], 0), 6.2f);
    // Rows are averaged like columns.
    Image turned = columnsOf({1, 2, 6}, 1);
    std::swap(turned.width, turned.height);
    EXPECT_FLOAT_EQ(redAt(smallerLevels(turned, false).at(0), 0), 3.0f);
}

TEST(TextureLevels, levelsHalveDownToOneTexelAndEqualTexelsStayWhatTheyAre) {
    const auto levels = smallerLevels(columnsOf(std::vector<float>(37, 0.1f), 11), false);
    std::vector<std::size_t> counts;
    for (const auto& level : levels) {
        counts.push_back(level.size() / 16);
        for (std::size_t i = 0; i < level.size() / 16; ++i) EXPECT_EQ(redAt(level, i), 0.1f);
    }
    EXPECT_EQ(counts, (std::vector<std::size_t>{18 * 5, 9 * 2, 4, 2, 1}));
}

TEST(TextureLevels, coloursAreAveragedInLinearLightAndAlphaAsItIs) {
    Image image;
    image.width = 3;
    image.height = 1;
    for (const int value : {0, 255, 255, 255}) image.texels.push_back(std::byte(value));
    for (int i = 0; i < 2; ++i)
        for (const int value : {255, 255, 0, 0}) image.texels.push_back(std::byte(value));
    const std::vector<std::byte> texel = smallerLevels(image, true).at(0);
    // Linear 2/3 and 1/3 are the sRGB codes 213.2 and 156.2 (IEC 61966-2-1).
    EXPECT_EQ(texel, (std::vector{std::byte(213), std::byte(255), std::byte(156), std::byte(85)}));
    EXPECT_EQ(smallerLevels(image, false).at(0),
              (std::vector{std::byte(170), std::byte(255), std::byte(85), std::byte(85)}));
}

TEST(TextureLevels, sidesThatArePowersOfTwoAreLeftToTheDriver) {
    for (const int side : {1, 2, 64, 4096}) EXPECT_FALSE(hasOddLevel(side, 8));
    for (const int side : {3, 6, 1000, 4095}) EXPECT_TRUE(hasOddLevel(8, side));
}

} // namespace
} // namespace tessera::frame
