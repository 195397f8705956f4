#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera::test {

/// The pointer as a screen shows it, which pictures of the screen leave out.
struct Cursor {
    glm::ivec2 sizePixels{0};
    std::vector<std::uint32_t> argb; ///< 8 bits per channel, multiplied by alpha; rows from the top

    /// Width and height of the part that is seen, in pixels; 0 where nothing is.
    glm::ivec2 extentPixels() const;
    bool operator==(const Cursor&) const = default;
};

/// The pointer of a display, as in DISPLAY, as it is now. Throws std::runtime_error where the X server does not tell.
/// Source: "The X Fixes Extension", version 1, GetCursorImage.
Cursor cursorOf(const std::string& display);

} // namespace tessera::test
