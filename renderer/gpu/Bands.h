#pragma once
#include <cstddef>
#include <functional>
#include <memory>

/// Long draws in pieces, so that a frame can be given up in the middle of one: a software rasteriser may need a second
/// for a full-screen triangle, and an interactive program owes an answer within a tenth of that.
namespace tessera::gpu {

/// How finely draws are divided.
struct BandPace {
    bool beginsSlow = false; ///< pixels are known to take long: bands are low from the first on
    /// A longer piece delays the answer to input too much, even if smaller pieces cost more in total.
    double longestMs = 100.0;
};

/// While one lives, drawInBands() and drawInParts() draw piece by piece, wait for each, and call `givesUp`; if that
/// returns true, they throw graph::Interrupted. The pixels of a complete frame do not depend on it. At most one lives
/// on a thread.
class BandedDrawing {
public:
    explicit BandedDrawing(std::function<bool()> givesUp, BandPace pace = {});
    ~BandedDrawing();
    BandedDrawing(const BandedDrawing&) = delete;
    BandedDrawing& operator=(const BandedDrawing&) = delete;
};

/// Issues `draw` once, or under BandedDrawing once per band of rows, scissored to the band: of the bound framebuffer,
/// or of the rectangle that setScissor() restricts draws to. The draw must write pixels only, and each on its own. Each
/// band repeats its geometry.
void drawInBands(const std::function<void()>& draw);

/// For draws whose geometry takes long: `draw` issues triangles [first, first + count) of all `triangles`, one after
/// the other. It is called once with all of them, or under BandedDrawing with a part at a time, in their order, so that
/// none is transformed twice; where pixels take long as well, each part in bands as above.
void drawInParts(std::size_t triangles, const std::function<void(std::size_t first, std::size_t count)>& draw);

/// A pass has ended. Under BandedDrawing: waits for the issued draws and calls `givesUp`.
void endBandedPass();

/// How far the frame is that is drawn under BandedDrawing, for its `givesUp`.
struct BandProgress {
    std::size_t passes = 0; ///< that have ended
    double share = 0.0;     ///< of the draw in progress: of its pixels, or of its triangles
};
BandProgress bandProgress();

/// While one lives, `givesUp` may draw something else: then targets, viewport, scissor and write masks are those of the
/// frame in progress again. Programs, vertex arrays, textures, blending and what is enabled are to be put back by
/// whoever draws.
class BetweenBands {
public:
    BetweenBands();
    ~BetweenBands();
    BetweenBands(const BetweenBands&) = delete;
    BetweenBands& operator=(const BetweenBands&) = delete;

private:
    struct Bound;
    std::unique_ptr<Bound> bound_;
};

/// Pixels that bands divide.
struct BandedArea {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    bool isScissored = false; ///< not the whole framebuffer
};
/// Called with every binding of a framebuffer and every scissor.
void setBandedArea(const BandedArea& area);

} // namespace tessera::gpu
