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

/// The latest picture, and when another may follow it without new input.
struct Gliding {
    static constexpr double kNextInputSeconds = 0.01; ///< within which a pointer that moves is heard of again

    bool isButtonHeld = false; ///< of the mouse
    bool isMoving = false;     ///< the picture changes by itself
    double ms = 0.0;           ///< that it took
    double shownAt = 0.0;      ///< seconds of Window::nowSeconds()

    /// From when on the next picture may follow, in the same seconds; 0: at once. In a drag the next movement of the
    /// pointer is waited for: a picture that takes longer than that would delay the answer to it.
    double from() const {
        const bool waits = isButtonHeld && isMoving && ms > 1000.0 * kNextInputSeconds;
        return waits ? shownAt + kNextInputSeconds : 0.0;
    }
};

} // namespace tessera::viewer
