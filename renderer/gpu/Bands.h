#pragma once
#include <cstddef>
#include <functional>
#include <memory>

/// Splits long draws, so that a frame can be interrupted in the middle of one: a software rasteriser may need a second
/// for a full-screen triangle, and an interactive program must respond within a tenth of that.
namespace tessera::gpu {

/// How finely draws are divided.
struct BandPace {
    bool beginsSlow = false; ///< pixels are known to be slow: starts with the lowest bands
    /// A longer piece delays the response to input too much, even if smaller pieces cost more in total.
    double longestMs = 100.0;
};

/// While an instance lives, drawInBands() and drawInParts() draw piece by piece, wait for each, call `givesUp`, and
/// throw graph::Interrupted if it returns true. The pixels of a complete frame do not depend on it. At most one
/// instance per thread.
class BandedDrawing {
public:
    explicit BandedDrawing(std::function<bool()> givesUp, BandPace pace = {});
    ~BandedDrawing();
    BandedDrawing(const BandedDrawing&) = delete;
    BandedDrawing& operator=(const BandedDrawing&) = delete;
};

/// Issues `draw` once, or under BandedDrawing once per band of rows, scissored to the band. Bands divide the bound
/// framebuffer, or the rectangle of setScissor(). The draw may only write pixels, each independent of the others. Each
/// band repeats its geometry.
void drawInBands(const std::function<void()>& draw);

/// For draws with slow geometry: `draw` issues triangles [first, first + count) of all `triangles`, in order. It is
/// called once for all, or under BandedDrawing once per part, so that no triangle is transformed twice. Where pixels
/// are slow too, each part is drawn in bands as above.
void drawInParts(std::size_t triangles, const std::function<void(std::size_t first, std::size_t count)>& draw);

/// Ends a pass. Under BandedDrawing, waits for the issued draws and calls `givesUp` as above.
void endBandedPass();

/// Progress of the frame under BandedDrawing, for its `givesUp`.
struct BandProgress {
    std::size_t passes = 0; ///< completed
    double share = 0.0;     ///< completed fraction of the current draw, by pixels or by triangles
};
BandProgress bandProgress();

/// While an instance lives, `givesUp` may draw something else. The destructor restores framebuffers, viewport, scissor,
/// sRGB encoding and write masks. The caller restores programs, vertex arrays, textures, blending and other
/// capabilities.
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

/// The rectangle of pixels that bands divide.
struct BandedArea {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    bool isScissored = false; ///< not the whole framebuffer
};
/// Called whenever a framebuffer is bound or a scissor is set.
void setBandedArea(const BandedArea& area);

} // namespace tessera::gpu
