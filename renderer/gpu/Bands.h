#pragma once
#include <functional>

/// Long draws in pieces, so that a frame can be given up in the middle of one: a software rasteriser may need a second
/// for a full-screen triangle, and an interactive program owes an answer within a tenth of that.
namespace tessera::gpu {

/// How finely draws are divided.
struct BandPace {
    bool beginsSlow =
        false; ///< pixels are known to take long: even geometry is drawn in small pieces from the first on
    /// A piece that takes longer is too long for a person who waits, whatever smaller ones cost together.
    double longestMs = 100.0;
};

/// While one lives, drawInBands() draws band by band, waits for each, and asks `givesUp`; where that says yes,
/// graph::Interrupted is thrown. Which pixels are written, and with what, does not depend on it. At most one lives on a
/// thread.
class BandedDrawing {
public:
    explicit BandedDrawing(std::function<bool()> givesUp, BandPace pace = {});
    ~BandedDrawing();
    BandedDrawing(const BandedDrawing&) = delete;
    BandedDrawing& operator=(const BandedDrawing&) = delete;
};

/// What a draw mostly costs besides its pixels.
enum class BandCost {
    Nothing, ///< as narrow bands as are needed
    Geometry ///< each band repeats it: a few bands, as long as they are not slow
};

/// Issues `draw` once; under BandedDrawing once a band of the bound framebuffer's rows, scissored to it. The draw must
/// write pixels only, and each on its own. Where setScissor() holds it is issued once.
void drawInBands(const std::function<void()>& draw, BandCost cost = BandCost::Nothing);

/// Under BandedDrawing: waits for what was drawn and asks. Done after every pass.
void askToGoOn();

/// The size of what is drawn into, for drawInBands(); 0 keeps it from scissoring. Called by whoever binds framebuffers.
void setBandedTarget(int width, int height);

} // namespace tessera::gpu
