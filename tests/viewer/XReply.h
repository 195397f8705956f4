#pragma once
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

#include <xcb/xcb.h>

namespace tessera::test {

/// What the X server answers is the caller's to free.
struct FreedByC {
    void operator()(void* memory) const { std::free(memory); }
};
template <class Reply>
using OwnedReply = std::unique_ptr<Reply, FreedByC>;

using XConnection = std::unique_ptr<xcb_connection_t, decltype(&xcb_disconnect)>;

/// Throws std::runtime_error where a display, as in DISPLAY, takes no connection.
inline XConnection connectTo(const std::string& display) {
    XConnection connection(xcb_connect(display.c_str(), nullptr), &xcb_disconnect);
    if (xcb_connection_has_error(connection.get()) != 0)
        throw std::runtime_error("cannot connect to the display " + display);
    return connection;
}

} // namespace tessera::test
