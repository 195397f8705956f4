#include "viewer/edit/ShownColor.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tessera::viewer {
namespace {

TEST(ShownColor, aColourIsShownByItsSrgbCode) {
    const glm::vec3 code = swatchOfColor({0.402f, 0.0f, 1.0f});
    EXPECT_EQ(std::lround(255.0f * code.x), 170) << "0.402 shown as it is would be 103";
    EXPECT_EQ(code.y, 0.0f);
    EXPECT_EQ(code.z, 1.0f);
    EXPECT_EQ(colorText({0.402f, 0.0f, 1.0f}), "#aa00ff in sRGB, linear 0.402 0 1");
}

TEST(ShownColor, ofBrighterThanADisplayTheHueIsShown) {
    const glm::vec3 color(4.0f, 2.0f, 0.0f);
    EXPECT_EQ(swatchScale(color), 4.0f);
    EXPECT_EQ(swatchOfColor(color), swatchOfColor({1.0f, 0.5f, 0.0f}));
    EXPECT_EQ(colorText(color), "4 x #ffbc00 in sRGB, linear 4 2 0");
    EXPECT_EQ(swatchScale({0.1f, 0.2f, 0.3f}), 1.0f) << "dark ones are shown dark";
}

TEST(ShownColor, whatIsPickedIsTheLinearValueOfItsCode) {
    const glm::vec3 before(0.402f, 0.1f, 0.3f), code = codeOfColor(before, 1.0f);
    const glm::vec3 picked = colorOfCode({200.0f / 255.0f, code.y, code.z}, code, before, 1.0f);
    EXPECT_NEAR(picked.x, 0.57758f, 1e-5f);
    EXPECT_EQ(picked.y, before.y) << "a channel that was not edited changed";
    EXPECT_EQ(picked.z, before.z);
    // The picker's digits round all channels to bytes.
    const auto rounded = [](float value) { return std::round(255.0f * value) / 255.0f; };
    const glm::vec3 typed = colorOfCode({200.0f / 255.0f, rounded(code.y), rounded(code.z)}, code, before, 1.0f);
    EXPECT_EQ(typed, glm::vec3(picked.x, before.y, before.z));
    EXPECT_EQ(colorOfCode({0.0f, 0.0f, 1.0f}, code, before, 8.0f), glm::vec3(0.0f, 0.0f, 8.0f));
}

TEST(ShownColor, theCodeOfWhatWasPickedIsWhatWasPicked) {
    for (const float scale : {1.0f, 3.7f})
        for (int byte = 0; byte < 256; ++byte) {
            const glm::vec3 code(float(byte) / 255.0f);
            const glm::vec3 linear = colorOfCode(code, glm::vec3(-1.0f), glm::vec3(0.0f), scale);
            EXPECT_NEAR(codeOfColor(linear, scale).x, code.x, 1e-5f) << byte;
        }
}

} // namespace
} // namespace tessera::viewer
