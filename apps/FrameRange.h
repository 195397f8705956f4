#pragma once
#include <cstddef>
#include <string>

namespace tessera::app {

/// Limit of frames in a sequence: all file names are in memory before the first is written.
inline constexpr int kMostFrames = 1'000'000;

/// Frame numbers of a sequence: first, first + step, and so on, up to last.
struct FrameRange {
    int first = 0, last = 0, step = 1; ///< 0 <= first <= last, 1 <= step
    std::size_t count() const { return std::size_t((last - first) / step) + 1; }
    /// Frame number at index `place` of the sequence, from 0.
    int frame(std::size_t place) const { return first + int(place) * step; }
    bool operator==(const FrameRange&) const = default;
};

/// Parses "90" as frames 0 to 89, "10:19" as 10 to 19 inclusive, "10:19:3" as every third of these. Throws InputError
/// that names --frames.
FrameRange frameRangeNamed(const std::string& text);

} // namespace tessera::app
