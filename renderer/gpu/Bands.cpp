#include "renderer/gpu/Bands.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include <glad/gl.h>

#include "renderer/gpu/Timer.h"
#include "renderer/graph/Execute.h"

namespace tessera::gpu {
namespace {

/// Target time of a piece. An interrupted frame and the frame that answers the input then fit into 100 ms.
constexpr double kPieceMs = 12.0;
/// Triangles of the first part; llvmpipe transforms and bins that many in about 1 ms.
constexpr std::size_t kFirstTriangles = 8192;
/// Triangles of the smallest part. With fewer, binding and waiting take as long.
constexpr std::size_t kFewestTriangles = 256;
/// Initial number of bands per part, until pixels prove fast.
constexpr int kFirstBands = 4;
/// Bands start at multiples of llvmpipe's rasteriser tile side, so that no tile is binned twice.
constexpr int kRowStep = 64;
/// Step of band height and width where bands of kRowStep are still too slow.
constexpr int kSlowStep = 16;

struct State {
    std::function<bool()> givesUp; ///< empty: draws are not split, also after it returned true while the frame unwinds
    BandPace pace;
    BandedArea area;
    BandProgress progress;
};
thread_local State state;

/// Rows of the next band, adapted to the time of the latest.
int nextRows(int rows, double elapsedMs) {
    const double wanted = rows * kPieceMs / std::max(elapsedMs, 0.1);
    // A single slow band, such as one whose shader was compiled first, must not shrink the next ones to nothing.
    const int steps = int(std::clamp(wanted, rows * 0.5, rows * 4.0)) / kRowStep;
    return std::max(steps, 1) * kRowStep;
}

/// Rounds up to a multiple of kRowStep, at least one step.
int wholeSteps(int rows) {
    return std::max((rows + kRowStep - 1) / kRowStep, 1) * kRowStep;
}

/// Waits for the issued draws and throws graph::Interrupted if givesUp() returns true. Only under BandedDrawing.
void finishOrGiveUp() {
    glFinish();
    if (!state.givesUp()) return;
    state.givesUp = nullptr;
    throw graph::Interrupted();
}

/// Size of bands, adapted while drawing.
struct Bands {
    int rows = 0;
    int columns = 0;            ///< width of a band's pieces
    int usualRows = 0;          ///< minimum rows once pixels are fast
    double growsWithinMs = 0.0; ///< bands below usualRows double if twice the slowest piece's time is less
};

/// BandProgress::share before and after a draw.
struct Shares {
    double before = 0.0;
    double after = 1.0;
};

/// Draws `width` by `height` pixels of the area, starting at a column and a row. Returns the time in milliseconds.
double drawPiece(const std::function<void()>& draw, int column, int row, int width, int height) {
    const BandedArea area = state.area;
    const CpuTimer clock;
    glEnable(GL_SCISSOR_TEST);
    glScissor(area.x + column, area.y + row, width, height);
    draw();
    glScissor(area.x, area.y, area.width, area.height);
    if (!area.isScissored) glDisable(GL_SCISSOR_TEST);
    glFinish();
    return clock.elapsedMs();
}

/// Draws the whole area band by band. Checks for interruption before each piece except the first of a draw. Returns the
/// time of the slowest piece in milliseconds.
double drawBands(const std::function<void()>& draw, Bands& bands, const Shares& shares) {
    const BandedArea area = state.area;
    const double longestMs = state.pace.longestMs;
    double slowestOfAllMs = 0.0;
    for (int row = 0; row < area.height;) {
        double slowestMs = 0.0; // of the band's pieces
        const int height = std::min(bands.rows, area.height - row);
        for (int column = 0; column < area.width;) {
            const double pixels = double(row) * area.width + double(height) * column;
            const double share =
                shares.before + (shares.after - shares.before) * pixels / (double(area.width) * area.height);
            if (share > 0.0) {
                state.progress.share = share;
                finishOrGiveUp();
            }
            const int width = std::min(bands.columns, area.width - column);
            const double ms = drawPiece(draw, column, row, width, height);
            slowestMs = std::max(slowestMs, ms);
            column += width;
            // Pieces narrow only where even the lowest bands are slow.
            if (ms > longestMs && bands.rows == kSlowStep)
                bands.columns = std::max(bands.columns / 4, std::min(kSlowStep, area.width));
            else if (2.0 * ms < longestMs && width == bands.columns) // not a piece cut by the edge
                bands.columns = std::min(bands.columns * 2, area.width);
        }
        row += height;
        slowestOfAllMs = std::max(slowestOfAllMs, slowestMs);
        if (slowestMs > longestMs)
            bands.rows = std::max(bands.rows / 4 / kSlowStep * kSlowStep, kSlowStep);
        else if (bands.columns == area.width && bands.rows >= bands.usualRows)
            bands.rows = std::clamp(nextRows(bands.rows, slowestMs), bands.usualRows, wholeSteps(area.height));
        else if (bands.columns == area.width && 2.0 * slowestMs < bands.growsWithinMs)
            bands.rows = std::min(bands.rows * 2, bands.usualRows);
    }
    return slowestOfAllMs;
}

} // namespace

BandedDrawing::BandedDrawing(std::function<bool()> givesUp, BandPace pace) {
    assert(!state.givesUp && "banded drawings do not nest");
    state.givesUp = std::move(givesUp);
    state.pace = pace;
    state.progress = {};
}

BandedDrawing::~BandedDrawing() {
    state.givesUp = nullptr;
}

void endBandedPass() {
    if (!state.givesUp) return;
    ++state.progress.passes;
    state.progress.share = 0.0;
    finishOrGiveUp();
}

BandProgress bandProgress() {
    return state.progress;
}

struct BetweenBands::Bound {
    BandedArea area;
    GLint drawn = 0, read = 0;
    GLint viewport[4] = {}, scissor[4] = {};
    GLboolean isScissored = GL_FALSE, isSrgb = GL_FALSE, color[4] = {}, depth = GL_FALSE;
};

BetweenBands::BetweenBands() : bound_(std::make_unique<Bound>()) {
    bound_->area = state.area;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound_->drawn);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound_->read);
    glGetIntegerv(GL_VIEWPORT, bound_->viewport);
    glGetIntegerv(GL_SCISSOR_BOX, bound_->scissor);
    bound_->isScissored = glIsEnabled(GL_SCISSOR_TEST);
    bound_->isSrgb = glIsEnabled(GL_FRAMEBUFFER_SRGB);
    glGetBooleanv(GL_COLOR_WRITEMASK, bound_->color);
    glGetBooleanv(GL_DEPTH_WRITEMASK, &bound_->depth);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

BetweenBands::~BetweenBands() {
    const auto enable = [](GLenum capability, GLboolean on) { on ? glEnable(capability) : glDisable(capability); };
    state.area = bound_->area;
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, GLuint(bound_->drawn));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, GLuint(bound_->read));
    glViewport(bound_->viewport[0], bound_->viewport[1], bound_->viewport[2], bound_->viewport[3]);
    glScissor(bound_->scissor[0], bound_->scissor[1], bound_->scissor[2], bound_->scissor[3]);
    enable(GL_SCISSOR_TEST, bound_->isScissored);
    enable(GL_FRAMEBUFFER_SRGB, bound_->isSrgb);
    glColorMask(bound_->color[0], bound_->color[1], bound_->color[2], bound_->color[3]);
    glDepthMask(bound_->depth);
}

void setBandedArea(const BandedArea& area) {
    state.area = area;
}

void drawInBands(const std::function<void()>& draw) {
    const BandedArea& area = state.area;
    if (!state.givesUp || area.width == 0 || (area.height <= kRowStep && !state.pace.beginsSlow)) return draw();
    Bands bands{state.pace.beginsSlow ? kSlowStep : kRowStep, area.width, kRowStep, state.pace.longestMs};
    drawBands(draw, bands, {0.0, 1.0});
}

void drawInParts(std::size_t triangles, const std::function<void(std::size_t first, std::size_t count)>& draw) {
    const BandedArea area = state.area;
    if (!state.givesUp || area.width == 0) return draw(0, triangles);
    const int whole = wholeSteps(area.height), first = wholeSteps(area.height / kFirstBands);
    // Above kPieceMs the part shrinks instead of its bands: lower bands would repeat its geometry.
    Bands bands{state.pace.beginsSlow ? kSlowStep : first, area.width, whole, std::min(kPieceMs, state.pace.longestMs)};
    std::size_t part = kFirstTriangles;
    for (std::size_t done = 0; done < triangles;) {
        const std::size_t count = std::min(part, triangles - done);
        const auto share = [&](std::size_t number) { return double(number) / double(triangles); };
        const double slowestMs = drawBands([&] { draw(done, count); }, bands, {share(done), share(done + count)});
        done += count;
        // Several bands repeat a part's geometry, so the part must be fast enough for its bands to grow.
        const bool isOneBand = bands.rows >= whole && bands.columns == area.width;
        const double aimMs = isOneBand ? kPieceMs : kPieceMs / 3.0;
        // The next part may cover more pixels, so parts grow by steps, and only once they are a single band.
        const double factor = std::clamp(aimMs / std::max(slowestMs, 0.1), 0.5, isOneBand ? 2.0 : 1.0);
        part = std::max(std::size_t(double(part) * factor), kFewestTriangles);
    }
}

} // namespace tessera::gpu
