#pragma once
#include <cstddef>
#include <string>

namespace tessera::app {

/// The most pictures of a sequence: their names are all known before the first is written.
inline constexpr int kMostFrames = 1'000'000;

/// Numbers of the frames of a sequence: first, first + step, and so on, none above last.
struct FrameRange {
    int first = 0, last = 0, step = 1; ///< 0 <= first <= last, 1 <= step
    std::size_t count() const { return std::size_t((last - first) / step) + 1; }
    /// The number of a frame; `place` counts the frames of the sequence from 0.
    int frame(std::size_t place) const { return first + int(place) * step; }
    bool operator==(const FrameRange&) const = default;
};

/// "90" is the frames 0 to 89, "10:19" is 10 to 19 with both, "10:19:3" every third of these. Throws InputError that
/// names --frames.
FrameRange frameRangeNamed(const std::string& text);

} // namespace tessera::app
