#include "tests/viewer/Cursor.h"

#include <stdexcept>

#include <glm/common.hpp>
#include <xcb/xfixes.h>

#include "tests/viewer/XReply.h"

namespace tessera::test {

glm::ivec2 Cursor::extentPixels() const {
    constexpr unsigned kAlphaShift = 24;
    glm::ivec2 least = sizePixels, most(-1);
    for (int y = 0; y < sizePixels.y; ++y)
        for (int x = 0; x < sizePixels.x; ++x) {
            if (argb[std::size_t(y * sizePixels.x + x)] >> kAlphaShift == 0) continue;
            least = glm::min(least, glm::ivec2(x, y));
            most = glm::max(most, glm::ivec2(x, y));
        }
    return glm::max(most - least + 1, glm::ivec2(0));
}

Cursor cursorOf(const std::string& display) {
    const XConnection connection = connectTo(display);
    xcb_connection_t* const x = connection.get();
    // The server answers no request before the version is negotiated.
    const OwnedReply<xcb_xfixes_query_version_reply_t> version(
        xcb_xfixes_query_version_reply(x, xcb_xfixes_query_version(x, 1, 0), nullptr));
    if (!version) throw std::runtime_error("the display " + display + " has no extension XFIXES");
    const OwnedReply<xcb_xfixes_get_cursor_image_reply_t> image(
        xcb_xfixes_get_cursor_image_reply(x, xcb_xfixes_get_cursor_image(x), nullptr));
    if (!image) throw std::runtime_error("the display " + display + " has no pointer");
    const std::uint32_t* const pixels = xcb_xfixes_get_cursor_image_cursor_image(image.get());
    return {{image->width, image->height},
            {pixels, pixels + xcb_xfixes_get_cursor_image_cursor_image_length(image.get())}};
}

} // namespace tessera::test
