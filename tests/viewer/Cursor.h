#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera::test {

/// The pointer's image on a screen, which screen captures omit.
struct Cursor {
    glm::ivec2 sizePixels{0};
    std::vector<std::uint32_t> argb; ///< 8 bits per channel, premultiplied by alpha; rows from the top

    /// Width and height of the visible part in pixels; 0 if nothing is visible.
    glm::ivec2 extentPixels() const;
    bool operator==(const Cursor&) const = default;
};

/// The current pointer of a display, named as in DISPLAY. Throws std::runtime_error if the X server does not return it.
/// Source: "The X Fixes Extension", version 1, GetCursorImage.
Cursor cursorOf(const std::string& display);

} // namespace tessera::test
