#pragma once
#include <glm/glm.hpp>

namespace tessera::viewer {

/// How large the window shows the picture's pixels: a part of the picture fills its place.
struct Magnification {
    static constexpr int kMost = 64;
    int times = 1;          ///< a power of two; 1: all of it is shown
    glm::vec2 corner{0.0f}; ///< of that part, a share of the picture's size from the upper left

    bool isOn() const { return times > 1; }
    /// The place of the picture that is shown at a share of the window's part, and back.
    glm::vec2 placeAt(const glm::vec2& share) const { return corner + share / float(times); }
    glm::vec2 shareOf(const glm::vec2& place) const { return (place - corner) * float(times); }
    /// Doubles or halves it so often; the pixel at a share stays there.
    void zoom(int steps, const glm::vec2& share);
    /// Moves the picture by a share of the window's part.
    void pan(const glm::vec2& share);
};

} // namespace tessera::viewer
