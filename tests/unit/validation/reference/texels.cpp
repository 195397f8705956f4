#include "validation/reference/Texels.h"

#include <cstring>
#include <numbers>

#include <gtest/gtest.h>

namespace tessera::reference {
namespace {

using scenes::Image;
using scenes::TexelFormat;
using scenes::TextureSlot;
using scenes::Wrap;

/// Two by two texels: red is the column, green the row.
Image fourTexels() {
    Image image;
    image.width = image.height = 2;
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x)
            for (const int value : {255 * x, 255 * y, 128, 51}) image.texels.push_back(std::byte(value));
    return image;
}

TEST(ReferenceTexels, srgbIsThatOfTheStandard) {
    EXPECT_EQ(linearFromSrgb(0.0), 0.0);
    EXPECT_EQ(linearFromSrgb(1.0), 1.0);
    EXPECT_NEAR(linearFromSrgb(128.0 / 255.0), 0.21586050011389923, 1e-15);
    EXPECT_NEAR(linearFromSrgb(0.04045), 0.0031308, 1e-8); // where the standard's two parts meet, by its own digits
    for (const double code : {0.0, 0.03, 0.05, 0.4, 1.0}) EXPECT_NEAR(srgbFromLinear(linearFromSrgb(code)), code, 1e-8);
}

TEST(ReferenceTexels, coloursAreDecodedAndAlphaAndNumbersNever) {
    const Image image = fourTexels();
    const glm::dvec4 color = texelAt(image, transferOf(TextureSlot::BaseColor), 1, 0);
    EXPECT_EQ(color.r, 1.0);
    EXPECT_EQ(color.b, linearFromSrgb(128.0 / 255.0));
    EXPECT_EQ(color.a, 51.0 / 255.0);
    EXPECT_EQ(texelAt(image, transferOf(TextureSlot::MetallicRoughness), 1, 0).b, 128.0 / 255.0);
    for (const TextureSlot slot : {TextureSlot::Emissive, TextureSlot::SpecularColor})
        EXPECT_EQ(transferOf(slot), Transfer::Srgb);
    for (const TextureSlot slot : {TextureSlot::Normal, TextureSlot::SpecularFactor, TextureSlot::Ior})
        EXPECT_EQ(transferOf(slot), Transfer::Linear);
}

TEST(ReferenceTexels, everyFormatIsReadInFull) {
    Image image;
    image.width = image.height = 1;
    image.format = TexelFormat::Rgba16Unorm;
    const std::uint16_t words[] = {1000, 30001, 65535, 7};
    image.texels.resize(sizeof words);
    std::memcpy(image.texels.data(), words, sizeof words);
    EXPECT_EQ(texelAt(image, Transfer::Linear, 0, 0).g, 30001.0 / 65535.0);
    EXPECT_EQ(texelAt(image, Transfer::Srgb, 0, 0).r, linearFromSrgb(1000.0 / 65535.0));
    image.format = TexelFormat::Rgba32Float;
    const float floats[] = {0.123456f, 7.5f, 1e-4f, 1.0f};
    image.texels.resize(sizeof floats);
    std::memcpy(image.texels.data(), floats, sizeof floats);
    for (int c = 0; c < 4; ++c) EXPECT_EQ(texelAt(image, Transfer::Srgb, 0, 0)[c], double(floats[c]));
}

TEST(ReferenceTexels, wrappingRepeatsClampsOrMirrors) {
    const int index[] = {-5, -4, -3, -2, -1, 0, 1, 2, 3, 4, 5, 6};
    const int repeated[] = {1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0};
    const int clamped[] = {0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2};
    const int mirrored[] = {1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0};
    for (std::size_t i = 0; i < std::size(index); ++i) {
        EXPECT_EQ(wrapped(index[i], 3, Wrap::Repeat), repeated[i]) << index[i];
        EXPECT_EQ(wrapped(index[i], 3, Wrap::ClampToEdge), clamped[i]) << index[i];
        EXPECT_EQ(wrapped(index[i], 3, Wrap::MirroredRepeat), mirrored[i]) << index[i];
    }
}

TEST(ReferenceTexels, aTransformScalesThenTurnsThenMoves) {
    scenes::TextureTransform transform;
    transform.scale = {2.0f, 3.0f};
    transform.offset = {0.5f, 0.25f};
    EXPECT_EQ(transformed(transform, {0.1, 0.2}), glm::dvec2(0.5 + 0.2, 0.25 + 3.0 * 0.2));
    transform.rotationRadians = std::numbers::pi_v<float> / 2.0f;
    // A quarter turn counter-clockwise with v downwards carries u to -v.
    const glm::dvec2 turned = transformed(transform, {1.0, 0.0});
    EXPECT_NEAR(turned.x, 0.5, 1e-7);
    EXPECT_NEAR(turned.y, 0.25 - 2.0, 1e-7);
}

} // namespace
} // namespace tessera::reference
