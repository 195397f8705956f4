#include <array>
#include <cstdint>
#include <numeric>

#include <gmock/gmock.h>

#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/Commands.h"
#include "renderer/gpu/ConstantRing.h"
#include "renderer/gpu/Program.h"
#include "tests/support/GlContext.h"
#include "tests/support/Random.h"

// Entry points of OpenGL as the loader declares them. Its header is private to renderer/gpu, so these tests repeat
// OpenGL's numbers (gl.xml of the Khronos registry).
extern "C" {
extern void (*glad_glMemoryBarrier)(unsigned);
extern void (*glad_glGetIntegeri_v)(unsigned, unsigned, int*);
extern void (*glad_glGetInteger64i_v)(unsigned, unsigned, std::int64_t*);
extern void* (*glad_glFenceSync)(unsigned, unsigned);
extern void (*glad_glDeleteSync)(void*);
extern void (*glad_glGetNamedBufferParameteri64v)(unsigned, unsigned, std::int64_t*);
}

namespace tessera::gpu {
namespace {

/// Records calls to OpenGL whose effect no image of a software rasteriser shows.
class GlCallsTest : public test::GlTest {};

unsigned recordedBits = 0;
int recordedBarriers = 0;

TEST_F(GlCallsTest, everySetOfBarriersIsIssuedWithAllItsBits) {
    const auto original = glad_glMemoryBarrier;
    glad_glMemoryBarrier = [](unsigned bits) {
        recordedBits = bits;
        ++recordedBarriers;
    };
    for (std::uint32_t set = 0; set < 1u << 9; ++set) {
        using graph::Barrier;
        const auto expected = [set](Barrier barrier, unsigned bits) {
            return (std::uint32_t(barrier) & set) != 0 ? bits : 0u;
        };
        recordedBits = 0;
        recordedBarriers = 0;
        memoryBarrier(Barrier(set));
        EXPECT_EQ(recordedBits, expected(Barrier::TextureFetch, 0x8) | expected(Barrier::ShaderImage, 0x20) |
                                    expected(Barrier::ShaderStorage, 0x2000) | expected(Barrier::Uniform, 0x4) |
                                    expected(Barrier::Framebuffer, 0x400) |
                                    // pixel buffers, textures and buffers
                                    expected(Barrier::TransferOrUpdate, 0x80 | 0x100 | 0x200) |
                                    expected(Barrier::VertexAttribute, 0x1) | expected(Barrier::ElementArray, 0x2) |
                                    expected(Barrier::Command, 0x40))
            << "of the set " << set;
        EXPECT_EQ(recordedBarriers, set == 0 ? 0 : 1);
    }
    glad_glMemoryBarrier = original;
}

/// The buffer range bound as the uniform block at a slot.
struct BoundRange {
    std::int64_t start = 0, bytes = 0, bufferBytes = 0;
};

BoundRange boundRange(std::uint32_t slot) {
    constexpr unsigned kUniformBufferBinding = 0x8A28, kUniformBufferStart = 0x8A29, kUniformBufferSize = 0x8A2A,
                       kBufferSize = 0x8764;
    BoundRange range;
    int buffer = 0;
    glad_glGetIntegeri_v(kUniformBufferBinding, slot, &buffer);
    glad_glGetInteger64i_v(kUniformBufferStart, slot, &range.start);
    glad_glGetInteger64i_v(kUniformBufferSize, slot, &range.bytes);
    glad_glGetNamedBufferParameteri64v(unsigned(buffer), kBufferSize, &range.bufferBytes);
    return range;
}

Program copying(const std::string& name, int vectors) {
    const std::string last = std::to_string(vectors - 1);
    const std::vector<StageSource> sources{{Stage::Compute, "#version 450 core\nlayout(local_size_x = 1) in;\n"
                                                            "layout(binding = 3, std140) uniform C { uvec4 value[" +
                                                                std::to_string(vectors) +
                                                                "]; };\n"
                                                                "layout(binding = 0, std430) buffer N { uint n[]; };\n"
                                                                "void main() { n[value[0].x] = value[0].y + value[" +
                                                                last + "].w; }"}};
    return Program(name, sources);
}

TEST_F(GlCallsTest, constantsOfAllSizesAreAlignedApartAndThoseOfTheirDispatch) {
    constexpr std::uint32_t kSlot = 3;
    constexpr std::size_t kSmallBytes = 16;
    const Program small = copying("small", kSmallBytes / 16), large = copying("large", ConstantRing::kMostBytes / 16);
    ConstantRing ring;
    constexpr std::uint32_t kCount = 400; // half of them large: some six rounds of the ring
    const Buffer numbers("numbers", kCount * sizeof(std::uint32_t));
    bindStorageBuffer(0, numbers);
    test::Random random(1);
    std::vector<std::uint32_t> expected;
    BoundRange before;
    int rounds = 0;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const bool isLarge = random.index(2) == 0;
        std::vector<std::uint32_t> words((isLarge ? ConstantRing::kMostBytes : kSmallBytes) / 4);
        std::iota(words.begin(), words.end(), 1000 * i);
        words[0] = i;
        expected.push_back(words[1] + words.back());
        ring.bind(kSlot, std::as_bytes(std::span(words)));
        const BoundRange range = boundRange(kSlot);
        // A GPU may require offsets that are multiples of 256 bytes, the largest alignment allowed.
        ASSERT_EQ(range.start % 256, 0) << "constants " << i;
        ASSERT_EQ(range.bytes, std::int64_t(words.size() * 4));
        // A half is rewritten once the GPU has read it, so constants must not extend into the other one.
        const std::int64_t half = range.bufferBytes / 2;
        ASSERT_EQ(range.start / half, (range.start + range.bytes - 1) / half) << "constants " << i;
        ASSERT_LE(range.start + range.bytes, range.bufferBytes);
        if (range.start / half == before.start / half && i > 0) {
            ASSERT_GE(range.start, before.start + before.bytes) << "constants " << i;
        }
        rounds += range.start < before.start;
        before = range;
        useProgram(isLarge ? large : small);
        dispatch(1);
    }
    EXPECT_GE(rounds, 3);
    memoryBarrier(graph::Barrier::TransferOrUpdate);
    EXPECT_EQ(numbers.downloadAs<std::uint32_t>(kCount), expected);
}

void* (*originalFenceSync)(unsigned, unsigned) = nullptr;
void (*originalDeleteSync)(void*) = nullptr;
int madeFences = 0, deletedFences = 0;

/// A half that is left gets a fence, which is deleted before the half is reused or with the ring.
TEST_F(GlCallsTest, everyFenceOfConstantsIsDeleted) {
    originalFenceSync = glad_glFenceSync;
    originalDeleteSync = glad_glDeleteSync;
    glad_glFenceSync = [](unsigned condition, unsigned flags) {
        ++madeFences;
        return originalFenceSync(condition, flags);
    };
    glad_glDeleteSync = [](void* fence) {
        deletedFences += fence != nullptr ? 1 : 0;
        originalDeleteSync(fence);
    };
    const std::vector<std::byte> bytes(ConstantRing::kMostBytes);
    for (const int left : {0, 1, 2, 3}) {
        madeFences = deletedFences = 0;
        {
            ConstantRing ring;
            for (int i = 0; madeFences < left && i < 1000; ++i) ring.bind(3, bytes);
        }
        EXPECT_EQ(madeFences, left);
        EXPECT_EQ(deletedFences, left);
    }
    glad_glFenceSync = originalFenceSync;
    glad_glDeleteSync = originalDeleteSync;
}

TEST_F(GlCallsTest, noConstantsAndMoreThanABlockHoldsAreRefused) {
    ConstantRing ring;
    const std::vector<std::byte> bytes(ConstantRing::kMostBytes + 1);
    EXPECT_EQ(bytes.size(), 16385u);
    EXPECT_NO_THROW(ring.bind(3, std::span(bytes).first(1)));
    EXPECT_NO_THROW(ring.bind(3, std::span(bytes).first(16384)));
    EXPECT_THROW(ring.bind(3, {}), std::logic_error);
    try {
        ring.bind(3, bytes);
        FAIL() << "16385 bytes are taken";
    } catch (const std::logic_error& error) {
        EXPECT_STREQ(error.what(), "constants of 16385 bytes; a uniform block may have 1 to 16384");
    }
}

} // namespace
} // namespace tessera::gpu
