// Drawing in parts (Bands.h): the triangles and the pixels of each piece.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <thread>
#include <utility>
#include <vector>

#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Commands.h"
#include "renderer/gpu/Texture.h"
#include "renderer/graph/Execute.h"
#include "tests/support/GlContext.h"

// Entry points of OpenGL as the loader declares them, whose header is private to renderer/gpu, and OpenGL's numbers
// (gl.xml of the Khronos registry).
extern "C" {
extern void (*glad_glGetIntegerv)(unsigned, int*);
extern unsigned char (*glad_glIsEnabled)(unsigned);
}

namespace tessera::gpu {
namespace {

bool isScissored() {
    return glad_glIsEnabled(0x0C11) != 0; // GL_SCISSOR_TEST
}

/// The triangles of a part, drawn to all pixels of its pieces.
struct DrawnPart {
    std::size_t first = 0;
    std::size_t count = 0;
    std::vector<int> timesDrawn; ///< by pixel
    int pieces = 0;
};

bool isOnePiece(const DrawnPart& part) {
    return part.pieces == 1;
}

class PartsTest : public test::GlTest {
protected:
    static constexpr int kWidth = 90, kHeight = 300; // not multiples of a band's rows or of a piece's columns
    static constexpr std::size_t kPixels = std::size_t(kWidth) * kHeight;

    void SetUp() override { bindFramebuffer(framebuffer); }
    /// Draws nothing, but sleeps for `ms` per piece and `nsEachTriangle` per triangle.
    void draw(std::size_t triangles, int ms = 0, double nsEachTriangle = 0.0) {
        drawInParts(triangles, [&](std::size_t first, std::size_t count) {
            if (parts.empty() || parts.back().first != first)
                parts.push_back({first, count, std::vector<int>(kPixels)});
            ++parts.back().pieces;
            EXPECT_EQ(parts.back().count, count);
            int box[4] = {0, 0, kWidth, kHeight};               // x, y, width, height
            if (isScissored()) glad_glGetIntegerv(0x0C10, box); // GL_SCISSOR_BOX
            for (int y = box[1]; y < box[1] + box[3]; ++y)
                for (int x = box[0]; x < box[0] + box[2]; ++x)
                    ++parts.back().timesDrawn.at(std::size_t(y) * kWidth + std::size_t(x));
            std::this_thread::sleep_for(std::chrono::milliseconds(ms) +
                                        std::chrono::nanoseconds(std::int64_t(nsEachTriangle * double(count))));
        });
    }
    void expectAllDrawnOnce(std::size_t triangles) const {
        std::size_t next = 0;
        for (const DrawnPart& part : parts) {
            ASSERT_EQ(part.first, next);
            next += part.count;
            EXPECT_EQ(part.timesDrawn, std::vector<int>(kPixels, 1)) << "triangles from " << part.first;
        }
        EXPECT_EQ(next, triangles);
    }

    std::vector<DrawnPart> parts; ///< in drawing order
    Texture target{"parts", {graph::Format::Rgba8Unorm, kWidth, kHeight, 1}};
    Framebuffer framebuffer{Attachments{{&target}}};
};

TEST_F(PartsTest, aWindowIsDrawnToWholeAndWithoutASecondEncoding) {
    bindWindowFramebuffer(5, 3);
    int drawn = -1, viewport[4] = {};
    glad_glGetIntegerv(0x8CA6, &drawn);   // GL_DRAW_FRAMEBUFFER_BINDING
    glad_glGetIntegerv(0x0BA2, viewport); // GL_VIEWPORT
    EXPECT_EQ(drawn, 0);
    EXPECT_EQ(std::vector(viewport, viewport + 4), (std::vector{0, 0, 5, 3}));
    EXPECT_FALSE(glad_glIsEnabled(0x8DB9)) << "GL_FRAMEBUFFER_SRGB: its colours are encoded already";
}

TEST_F(PartsTest, withoutBandedDrawingAllTrianglesAreDrawnAtOnce) {
    draw(100'000);
    ASSERT_EQ(parts.size(), 1u);
    expectAllDrawnOnce(100'000);
}

TEST_F(PartsTest, everyTriangleIsDrawnOnceOnEveryPixelAndInOrder) {
    for (const BandPace& pace :
         {BandPace{}, BandPace{.beginsSlow = true}, BandPace{.beginsSlow = true, .longestMs = 0}}) {
        SCOPED_TRACE(testing::Message() << pace.beginsSlow << ' ' << pace.longestMs);
        parts.clear();
        double share = 0.0;
        const auto watch = [&share] {
            EXPECT_GT(bandProgress().share, share);
            EXPECT_LT(bandProgress().share, 1.0);
            share = bandProgress().share;
            return false;
        };
        const BandedDrawing banded(watch, pace);
        draw(20'000);
        EXPECT_GT(parts.size(), 1u);
        expectAllDrawnOnce(20'000);
        EXPECT_FALSE(isScissored());
    }
}

TEST_F(PartsTest, quickPartsGrow) {
    const BandedDrawing banded([] { return false; });
    draw(1'000'000);
    expectAllDrawnOnce(1'000'000);
    const auto larger = [](const DrawnPart& a, const DrawnPart& b) { return a.count < b.count; };
    EXPECT_GT(std::ranges::max_element(parts, larger)->count, 4 * parts.front().count);
}

TEST_F(PartsTest, whereTrianglesAreSlowThePartsShrinkUntilBandsNeedNotRepeatThem) {
    const BandedDrawing banded([] { return false; });
    draw(100'000, 0, 1000.0); // 8 ms for the first part: less than a piece should take, but more than half of it
    EXPECT_GT(parts.front().pieces, 1);
    EXPECT_TRUE(std::ranges::any_of(parts, isOnePiece));
}

TEST_F(PartsTest, slowBandsOfANarrowAreaGrowAgain) {
    setScissor({0, 0, 8, kHeight});
    std::vector<int> pieces; // number of pieces by part
    std::size_t latest = 1;  // no part begins there
    {
        const BandedDrawing banded([] { return false; }, {.longestMs = 20});
        drawInParts(1'000'000, [&](std::size_t first, std::size_t) {
            if (std::exchange(latest, first) != first) pieces.push_back(0);
            ++pieces.back();
            if (pieces.size() == 1) std::this_thread::sleep_for(std::chrono::milliseconds(25));
        });
    }
    bindFramebuffer(framebuffer); // resets the scissor
    EXPECT_GT(pieces.front(), 5) << "as low and narrow as can be";
    EXPECT_TRUE(std::ranges::find(pieces, 1) != pieces.end());
}

TEST_F(PartsTest, partsThatTakeLongShrinkAndCanBeAbandoned) {
    const BandedDrawing banded([this] { return parts.size() == 3; });
    EXPECT_THROW(draw(1'000'000, 40), graph::Interrupted);
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_EQ(parts[1].count, parts[0].count / 2);
    EXPECT_EQ(parts[2].count, parts[1].count / 2);
}

} // namespace
} // namespace tessera::gpu
