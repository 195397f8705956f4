#include "renderer/gpu/Bands.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include <glad/gl.h>

#include "renderer/gpu/Timer.h"
#include "renderer/graph/Execute.h"

namespace tessera::gpu {
namespace {

/// What a band should take: an interrupted frame, and the one that answers the input, fit into 100 ms.
constexpr double kBandMs = 12.0;
/// Of draws whose geometry each band repeats, at most, unless bands are slow.
constexpr int kGeometryBands = 4;
/// Bands begin at multiples of the side of llvmpipe's rasteriser tiles, so that none is binned twice.
constexpr int kRowStep = 64;
/// Where bands are slow all the same, their height and width change in steps of this.
constexpr int kSlowStep = 16;

struct State {
    std::function<bool()> givesUp; ///< empty: draws are whole; also once it said yes, while the frame is left
    BandPace pace;
    BandedArea area;
    BandProgress progress;
};
thread_local State state;

/// Rows of the next band, from what the latest one took.
int nextRows(int rows, double elapsedMs) {
    const double wanted = rows * kBandMs / std::max(elapsedMs, 0.1);
    // A single slow band, such as one whose shader was compiled first, must not shrink the next ones to nothing.
    const int steps = int(std::clamp(wanted, rows * 0.5, rows * 4.0)) / kRowStep;
    return std::max(steps, 1) * kRowStep;
}

/// Waits for the issued draws and asks whether to go on; under BandedDrawing.
void askToGoOn() {
    glFinish();
    if (!state.givesUp()) return;
    state.givesUp = nullptr;
    throw graph::Interrupted();
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
    askToGoOn();
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

void drawInBands(const std::function<void()>& draw, BandCost cost) {
    const BandedArea area = state.area;
    if (!state.givesUp || area.width == 0 || (area.height <= kRowStep && !state.pace.beginsSlow)) return draw();
    const int quarter = (area.height / kGeometryBands + kRowStep - 1) / kRowStep * kRowStep;
    const int usualRows = cost == BandCost::Geometry ? quarter : kRowStep;
    int rows = state.pace.beginsSlow ? kSlowStep : usualRows, columns = area.width;
    for (int row = 0; row < area.height;) {
        double slowestMs = 0.0; // of the band's pieces
        for (int column = 0; column < area.width;) {
            if (row + column > 0) {
                const double here = double(std::min(rows, area.height - row)) * column;
                state.progress.share = (double(row) * area.width + here) / (double(area.width) * area.height);
                askToGoOn();
            }
            const CpuTimer clock;
            glEnable(GL_SCISSOR_TEST);
            const int width = std::min(columns, area.width - column);
            glScissor(area.x + column, area.y + row, width, std::min(rows, area.height - row));
            draw();
            glScissor(area.x, area.y, area.width, area.height);
            if (!area.isScissored) glDisable(GL_SCISSOR_TEST);
            glFinish();
            const double ms = clock.elapsedMs();
            slowestMs = std::max(slowestMs, ms);
            column += width;
            // Narrower than the picture only where even the lowest bands are slow.
            if (ms > state.pace.longestMs && rows == kSlowStep)
                columns = std::max(columns / 4, kSlowStep);
            else if (2.0 * ms < state.pace.longestMs && width == columns) // not of one that the edge cut
                columns = std::min(columns * 2, area.width);
        }
        row += rows;
        if (slowestMs > state.pace.longestMs)
            rows = std::max(rows / 4 / kSlowStep * kSlowStep, kSlowStep);
        else if (columns == area.width && rows >= usualRows)
            rows = std::max(nextRows(rows, slowestMs), usualRows);
        else if (columns == area.width && 2.0 * slowestMs < state.pace.longestMs)
            rows = std::min(rows * 2, usualRows);
    }
}

} // namespace tessera::gpu
