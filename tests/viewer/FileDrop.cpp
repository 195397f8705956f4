#include "tests/viewer/FileDrop.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <thread>

#include <xcb/xcb.h>

#include "tests/viewer/XReply.h"

namespace tessera::test {
namespace {

/// The source program of a drag. The window that receives X11's messages is never shown.
class DragSource {
public:
    DragSource(const std::string& display, xcb_window_t target) : connection_(connectTo(display)), target_(target) {
        const xcb_window_t root = xcb_setup_roots_iterator(xcb_get_setup(connection_.get())).data->root;
        own_ = xcb_generate_id(connection_.get());
        xcb_create_window(connection_.get(), 0, own_, root, 0, 0, 1, 1, 0, XCB_WINDOW_CLASS_INPUT_ONLY,
                          XCB_COPY_FROM_PARENT, 0, nullptr);
    }

    void drop(const std::string& uris, glm::ivec2 pixel) {
        constexpr std::uint32_t kVersion = 5u << 24u;
        const auto place = std::uint32_t(pixel.x) << 16u | std::uint32_t(pixel.y);
        xcb_set_selection_owner(connection_.get(), own_, atom("XdndSelection"), XCB_CURRENT_TIME);
        send("XdndEnter", {own_, kVersion, atom("text/uri-list"), 0, 0});
        send("XdndPosition", {own_, 0, place, XCB_CURRENT_TIME, atom("XdndActionCopy")});
        awaitYes("XdndStatus", uris);
        send("XdndDrop", {own_, 0, XCB_CURRENT_TIME, 0, 0});
        awaitYes("XdndFinished", uris);
    }

private:
    xcb_atom_t atom(const std::string& name) {
        const auto cookie = xcb_intern_atom(connection_.get(), 0, std::uint16_t(name.size()), name.c_str());
        const OwnedReply<xcb_intern_atom_reply_t> reply(xcb_intern_atom_reply(connection_.get(), cookie, nullptr));
        if (!reply) throw std::runtime_error("the display has no atom " + name);
        return reply->atom;
    }

    template <class Event>
    void send(xcb_window_t to, const Event& event) {
        std::array<char, 32> bytes{}; // size of any event
        static_assert(sizeof(Event) <= sizeof bytes);
        std::memcpy(bytes.data(), &event, sizeof event);
        xcb_send_event(connection_.get(), 0, to, XCB_EVENT_MASK_NO_EVENT, bytes.data());
        xcb_flush(connection_.get());
    }

    void send(const std::string& message, const std::array<std::uint32_t, 5>& values) {
        xcb_client_message_event_t event{};
        event.response_type = XCB_CLIENT_MESSAGE;
        event.format = 32;
        event.window = target_;
        event.type = atom(message);
        std::memcpy(event.data.data32, values.data(), sizeof values);
        send(target_, event);
    }

    /// Supplies the dragged data until the window answers with `message`, which must accept the drop.
    void awaitYes(const std::string& message, const std::string& uris) {
        const xcb_atom_t awaited = atom(message);
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (std::chrono::steady_clock::now() < end) {
            const OwnedReply<xcb_generic_event_t> event(xcb_poll_for_event(connection_.get()));
            if (!event) {
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
                continue;
            }
            const int kind = event->response_type & 0x7f; // without the flag of events sent by programs
            if (kind == XCB_SELECTION_REQUEST)
                handOver(reinterpret_cast<const xcb_selection_request_event_t&>(*event), uris);
            if (kind != XCB_CLIENT_MESSAGE) continue;
            const auto& answer = reinterpret_cast<const xcb_client_message_event_t&>(*event);
            if (answer.type != awaited) continue;
            if (answer.data.data32[1] != 0) return; // GLFW finishes with the number of bytes it accepted instead of 1
            throw std::runtime_error("the window does not take what is dropped: " + message);
        }
        throw std::runtime_error("the window did not answer what is dropped within 30 s: no " + message);
    }

    void handOver(const xcb_selection_request_event_t& request, const std::string& uris) {
        xcb_change_property(connection_.get(), XCB_PROP_MODE_REPLACE, request.requestor, request.property,
                            request.target, 8, std::uint32_t(uris.size()), uris.data());
        xcb_selection_notify_event_t event{};
        event.response_type = XCB_SELECTION_NOTIFY;
        event.time = request.time;
        event.requestor = request.requestor;
        event.selection = request.selection;
        event.target = request.target;
        event.property = request.property;
        send(request.requestor, event);
    }

    XConnection connection_;
    xcb_window_t target_, own_ = 0;
};

} // namespace

void dropFiles(const std::string& display, const std::string& window, glm::ivec2 pixel,
               const std::vector<std::filesystem::path>& files) {
    std::string uris;
    for (const std::filesystem::path& file : files) uris += "file://" + file.string() + "\r\n";
    DragSource(display, xcb_window_t(std::stoul(window))).drop(uris, pixel);
}

} // namespace tessera::test
