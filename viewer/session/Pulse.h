#pragma once
#include <algorithm>

namespace tessera::viewer {

/// Schedules redraws of the window.
struct Pulse {
    static constexpr double kRestSeconds = 0.15; ///< without input or movement until the image is idle
    /// Frames after the last event in which the user interface may still change: a list that opens is measured in one
    /// frame and laid out in the next.
    static constexpr int kSettleFrames = 3;

    int settleFrames = kSettleFrames; ///< still to be drawn in any case
    double restAt = 0.0;              ///< when everything is idle, in seconds of Window::nowSeconds()

    void settle() { settleFrames = kSettleFrames; }
    /// Requests a frame that shows the results of this one.
    void another() { settleFrames = std::max(settleFrames, 1); }
    void stirred(double nowSeconds) { restAt = nowSeconds + kRestSeconds; }
};

/// The latest image, and the earliest time of the next one without new input.
struct Gliding {
    static constexpr double kNextInputSeconds = 0.01; ///< interval in which a moving pointer sends another event

    bool isButtonHeld = false; ///< of the mouse
    bool isMoving = false;     ///< the image changes by itself
    double ms = 0.0;           ///< drawing time
    double shownAt = 0.0;      ///< seconds of Window::nowSeconds()

    /// Earliest time of the next image, in the same seconds; 0: at once. During a drag it waits for the next pointer
    /// event if images take longer than that: drawing earlier would delay the response.
    double from() const {
        const bool waits = isButtonHeld && isMoving && ms > 1000.0 * kNextInputSeconds;
        return waits ? shownAt + kNextInputSeconds : 0.0;
    }
};

} // namespace tessera::viewer
