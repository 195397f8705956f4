#pragma once
#include <algorithm>

namespace tessera::viewer {

/// When the window is drawn again.
struct Pulse {
    static constexpr double kRestSeconds = 0.15; ///< without input or movement, after which the picture is drawn whole
    /// Frames after the last event in which the user interface may still change: a list that opens is measured in one
    /// frame and laid out in the next.
    static constexpr int kSettleFrames = 3;

    int settleFrames = kSettleFrames; ///< that follow in any case
    double restAt = 0.0;              ///< seconds of Window::nowSeconds(), from which on all rests

    void settle() { settleFrames = kSettleFrames; }
    /// What this frame found is shown by the next.
    void another() { settleFrames = std::max(settleFrames, 1); }
    void stirred(double nowSeconds) { restAt = nowSeconds + kRestSeconds; }
};

} // namespace tessera::viewer
