#include <bit>
#include <cstring>
#include <numeric>

#include <gmock/gmock.h>

#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/Commands.h"
#include "renderer/gpu/Program.h"
#include "renderer/gpu/Sampler.h"
#include "renderer/gpu/TexelBuffer.h"
#include "renderer/gpu/Texture.h"
#include "tests/support/ErrorText.h"
#include "tests/support/GlContext.h"

namespace tessera::gpu {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

class BufferTest : public test::GlTest {};
class TextureTest : public test::GlTest {};
class TexelBufferTest : public test::GlTest {};

TEST_F(BufferTest, writtenBytesAreReadBack) {
    for (const BufferUse use : {BufferUse::Static, BufferUse::Dynamic, BufferUse::Readback}) {
        const Buffer buffer("numbers", 5 * sizeof(float), use);
        buffer.upload(std::vector<float>{1, 2, 3, 4, 5});
        buffer.uploadValue(9.0f, 2 * sizeof(float));
        EXPECT_THAT(buffer.downloadAs<float>(5), ElementsAre(1, 2, 9, 4, 5));
        EXPECT_THAT(buffer.downloadAs<float>(2, 3 * sizeof(float)), ElementsAre(4, 5));
    }
}

TEST_F(BufferTest, aNewBufferIsZeroAndNeverEmpty) {
    const Buffer empty("empty", 0);
    EXPECT_EQ(empty.bytes(), 16u);
    EXPECT_THAT(empty.downloadAs<std::uint32_t>(4), Each(0u));
    // A driver may reuse memory without clearing it; llvmpipe zeroes it, others do not.
    const auto make = [](int i) { return Buffer("small " + std::to_string(i), 256); };
    for (int i = 0; i < 64; ++i) make(i).upload(std::vector<std::uint32_t>(64, 0xffffffffu));
    for (int i = 0; i < 64; ++i) EXPECT_THAT(make(i).downloadAs<std::uint32_t>(64), Each(0u));
}

TEST_F(BufferTest, anyNumberOfBytesIsCleared) {
    const Buffer odd = Buffer::of("odd", std::vector<std::uint8_t>{1, 2, 3, 4, 5});
    odd.clear();
    EXPECT_THAT(odd.downloadAs<std::uint8_t>(5), Each(0));
}

TEST_F(TextureTest, everyLevelOfEveryFormatIsCleared) {
    for (int i = 0; i < int(graph::Format::Count); ++i) {
        const graph::FormatInfo& info = graph::formatInfo(graph::Format(i));
        SCOPED_TRACE(info.name);
        const Texture texture("cleared", {.format = info.format, .width = 4, .height = 2, .levels = 2});
        for (int level = 0; level < 2; ++level)
            texture.upload(level, std::vector<std::byte>(texture.levelBytes(level), std::byte(1)));
        texture.clear();
        for (int level = 0; level < 2; ++level) EXPECT_THAT(texture.downloadBytes(level), Each(std::byte(0)));
    }
}

TEST_F(BufferTest, aMovedBufferIsTheSameOne) {
    Buffer first = Buffer::of("a", std::vector<int>{1, 2});
    Buffer second = Buffer::of("b", std::vector<int>{3, 4});
    second = std::move(first);
    EXPECT_THAT(second.downloadAs<int>(2), ElementsAre(1, 2));
    EXPECT_EQ(second.label(), "a");
}

TEST_F(BufferTest, tooLargeABufferIsRefusedByLabelAndSize) {
    const std::size_t bytes = std::size_t(1) << 46; // 64 TiB: no machine has it, and it fits GLsizeiptr
    EXPECT_THAT(test::errorText<std::runtime_error>([&] { Buffer("light list", bytes); }),
                HasSubstr("not enough graphics memory for buffer 'light list' (70368744177664 bytes)"));
}

TEST_F(TextureTest, componentsAreReadAsFloatsOrWholeNumbersOfEveryFormat) {
    const auto bits = [](float number) { return std::bit_cast<std::uint32_t>(number); };
    for (int i = 0; i < int(graph::Format::Count); ++i) {
        const graph::FormatInfo& info = graph::formatInfo(graph::Format(i));
        SCOPED_TRACE(info.name);
        const Texture texture("components", {info.format, 2, 1, 1});
        texture.upload(0, std::vector<std::byte>(std::size_t(2 * info.bytes)));
        glm::uvec4 zero(0u, 0u, 0u, info.components == 4 ? 0u : info.integer ? 1u : bits(1.0f));
        EXPECT_THAT(texture.downloadComponents(), Each(zero));
    }
    const Texture depth("components", {graph::Format::Depth32Float, 1, 1, 1});
    depth.upload(0, std::vector<float>{0.25f});
    EXPECT_THAT(depth.downloadComponents(), ElementsAre(glm::uvec4(bits(0.25f), 0u, 0u, bits(1.0f))));
    const Texture bytes("components", {graph::Format::Rgba8Unorm, 1, 1, 1});
    bytes.upload(0, std::vector<std::uint8_t>{255, 0, 255, 0});
    EXPECT_THAT(bytes.downloadComponents(), ElementsAre(glm::uvec4(bits(1.0f), bits(0.0f), bits(1.0f), bits(0.0f))));
    const Texture counts("components", {graph::Format::Rg16Uint, 1, 1, 1});
    counts.upload(0, std::vector<std::uint16_t>{65535, 3});
    EXPECT_THAT(counts.downloadComponents(), ElementsAre(glm::uvec4(65535u, 3u, 0u, 1u)));
}

TEST_F(TextureTest, texelsOfEveryFormatSurviveARoundTrip) {
    for (int i = 0; i < int(graph::Format::Count); ++i) {
        const auto format = graph::Format(i);
        const graph::FormatInfo& info = graph::formatInfo(format);
        const Texture texture("round trip", {format, 7, 3, 1}); // odd sizes: rows are not aligned
        std::vector<std::byte> texels(texture.levelBytes(0));
        ASSERT_EQ(texels.size(), std::size_t(7 * 3 * info.bytes));
        if (info.name.ends_with("32F")) {
            std::vector<float> values(texels.size() / sizeof(float));
            // Depth is clamped to 0..1, so the values stay there.
            for (std::size_t k = 0; k < values.size(); ++k) values[k] = float(k) / float(values.size());
            std::memcpy(texels.data(), values.data(), texels.size());
        } else {
            // Only bits of 0x3b: neither NaN nor infinite as a half, not -32768 as a 16-bit signed-normalised number.
            for (std::size_t k = 0; k < texels.size(); ++k) texels[k] = std::byte((k * 7 + 1) & 0x3b);
        }
        texture.upload(0, std::span<const std::byte>(texels));
        EXPECT_EQ(texture.downloadBytes(), texels) << info.name;
    }
}

TEST_F(TextureTest, mipLevelsHalveDownToOneTexel) {
    EXPECT_EQ(graph::mipLevelsFor(1, 1), 1);
    EXPECT_EQ(graph::mipLevelsFor(8, 3), 4);
    EXPECT_EQ(graph::mipLevelsFor(8193, 1), 14);
    const Texture texture("mips", {graph::Format::R32Float, 4, 2, 1, graph::mipLevelsFor(4, 2)});
    texture.upload(0, std::vector<float>{1, 3, 5, 7, 1, 3, 5, 7});
    texture.generateMips();
    EXPECT_THAT(texture.downloadAs<float>(1), ElementsAre(2, 6));
    EXPECT_THAT(texture.downloadAs<float>(2), ElementsAre(4));
}

TEST_F(TextureTest, sizesAndSamplesBeyondTheDriverAreRefusedByName) {
    const int side = context().capabilities().maxTextureSize + 1;
    EXPECT_THAT(test::errorText<std::runtime_error>([&] {
                    Texture("wide", {graph::Format::R8Uint, side, 1, 1});
                }),
                HasSubstr("texture 'wide' (" + std::to_string(side) + " x 1 R8UI) is larger than this driver's limit"));
    EXPECT_THAT(test::errorText<std::runtime_error>([&] {
                    Texture("none", {graph::Format::R8Uint, 0, 4, 1});
                }),
                HasSubstr("has no texel"));
    const int samples = context().capabilities().maxSamples * 2;
    EXPECT_THAT(test::errorText<std::runtime_error>([&] {
                    Texture("fine", {graph::Format::Rgba8Unorm, 4, 4, samples});
                }),
                HasSubstr("has more samples than this driver's limit"));
}

TEST_F(TextureTest, aMultisampledTextureIsNotReadBackUnresolved) {
    const Texture texture("many", {graph::Format::Rgba32Float, 4, 4, 4});
    EXPECT_THAT(test::errorText<std::runtime_error>([&] { texture.downloadBytes(); }),
                HasSubstr("resolve it with blit() first"));
}

TEST_F(TextureTest, serialsAreNotUsedTwice) {
    std::uint64_t first = 0;
    std::weak_ptr<const std::uint64_t> alive;
    {
        const Texture texture("a", {graph::Format::R8Uint, 1, 1, 1});
        first = *texture.serial();
        alive = texture.serial();
    }
    EXPECT_TRUE(alive.expired());
    EXPECT_NE(*Texture("b", {graph::Format::R8Uint, 1, 1, 1}).serial(), first);
}

TEST_F(TexelBufferTest, aShaderReadsTheBuffersTexels) {
    const Buffer numbers = Buffer::of("numbers", std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8});
    const TexelBuffer texels("texels", graph::Format::Rgba32Float, numbers);
    EXPECT_EQ(texels.texels(), 2u);
    const Buffer result("result", 2 * sizeof(float));
    const std::vector<StageSource> sources{{Stage::Compute, R"(#version 450 core
layout(local_size_x = 2) in;
layout(binding = 3) uniform samplerBuffer numbers;
layout(binding = 1, std430) buffer Result { float sums[]; };
void main() {
    vec4 texel = texelFetch(numbers, int(gl_GlobalInvocationID.x));
    sums[gl_GlobalInvocationID.x] = texel.x + texel.y + texel.z + texel.w;
})"}};
    const Program program("sums", sources);
    EXPECT_EQ(program.samplerUnit("numbers"), 3);
    useProgram(program);
    bindTexelBuffer(3, texels);
    bindStorageBuffer(1, result);
    dispatch(1);
    memoryBarrier(graph::Barrier::TransferOrUpdate);
    EXPECT_THAT(result.downloadAs<float>(2), ElementsAre(10, 26));
}

TEST_F(TexelBufferTest, aFormatThatBufferTexturesLackIsRefusedByName) {
    const Buffer buffer("b", 64);
    EXPECT_THAT(test::errorText<std::runtime_error>([&] { TexelBuffer("t", graph::Format::Srgb8Alpha8, buffer); }),
                HasSubstr("texel buffer 't': buffer textures cannot be SRGB8_ALPHA8"));
}

TEST_F(TextureTest, everySamplerOfTheSceneFormatIsAccepted) {
    for (int filter = 0; filter <= int(scenes::Filter::LinearMipmapLinear); ++filter)
        for (int wrap = 0; wrap <= int(scenes::Wrap::MirroredRepeat); ++wrap)
            Sampler("s", {scenes::Filter(filter), scenes::Filter(filter), scenes::Wrap(wrap), scenes::Wrap(wrap)},
                    16.0f);
    Sampler::linearClamp();
    EXPECT_NO_THROW(throwIfFailed());
}

} // namespace
} // namespace tessera::gpu
