#pragma once
#include <glm/glm.hpp>

namespace tessera::viewer {

/// Magnification of the image: a part of it fills the viewport.
struct Magnification {
    static constexpr int kMost = 64;
    int times = 1;          ///< a power of two; 1: all of the image is shown
    glm::vec2 corner{0.0f}; ///< of that part, a fraction of the image size from the upper left

    bool isOn() const { return times > 1; }
    /// Converts a fraction of the viewport to the image position shown there, and back.
    glm::vec2 placeAt(const glm::vec2& share) const { return corner + share / float(times); }
    glm::vec2 shareOf(const glm::vec2& place) const { return (place - corner) * float(times); }
    /// Doubles or halves it once per step; the pixel at the position `share` stays there.
    void zoom(int steps, const glm::vec2& share);
    /// Pans the image by a fraction of the viewport.
    void pan(const glm::vec2& share);
};

} // namespace tessera::viewer
