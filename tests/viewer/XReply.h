#pragma once
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

#include <xcb/xcb.h>

namespace tessera::test {

/// Frees replies of the X server, which the caller owns.
struct FreedByC {
    void operator()(void* memory) const { std::free(memory); }
};
template <class Reply>
using OwnedReply = std::unique_ptr<Reply, FreedByC>;

using XConnection = std::unique_ptr<xcb_connection_t, decltype(&xcb_disconnect)>;

/// Connects to a display, named as in DISPLAY. Throws std::runtime_error if it accepts no connection.
inline XConnection connectTo(const std::string& display) {
    XConnection connection(xcb_connect(display.c_str(), nullptr), &xcb_disconnect);
    if (xcb_connection_has_error(connection.get()) != 0)
        throw std::runtime_error("cannot connect to the display " + display);
    return connection;
}

} // namespace tessera::test
