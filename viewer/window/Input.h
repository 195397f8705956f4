#pragma once
#include <deque>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace tessera::viewer {

/// One thing the user did, as the window system told it. Keys and buttons are GLFW's numbers.
struct InputEvent {
    enum class Kind { Move, Button, Scroll, Key, Character, Focus };
    Kind kind = Kind::Move;
    int code = 0;              ///< key, button or Unicode character
    bool down = false;         ///< of a key (also when it repeats), a button or the focus
    bool repeated = false;     ///< the key was held down
    int modifiers = 0;         ///< GLFW_MOD_*
    glm::vec2 position{0.0f};  ///< of the pointer, screen coordinates from the upper left
    glm::vec2 scroll{0.0f};    ///< steps
    int letter = 0;            ///< of a key: what the keyboard's layout has there, if that is a letter: 'A' to 'Z'
    double heardSeconds = 0.0; ///< when it was taken from the window system, by Window::nowSeconds()
};

/// Events wait here until a frame takes them, so that none is lost while a frame is drawn.
class InputQueue {
public:
    void push(const InputEvent& event);
    /// The events of the next frame: as many as one frame of a user interface can tell apart. It sees a pointer in one
    /// place, a button or key either down or up, Shift and Ctrl held throughout or not at all, and text before other
    /// keys. So the events end before one that would undo what another of them did, before the pointer moves on from
    /// where a button changed, before a button is let go where the pointer came to, which a slider would not heed,
    /// before Shift or Ctrl change after something that heeds them, and before text that was typed after a key such as
    /// Enter. With `keysWait` they also end before the first press of a key.
    std::vector<InputEvent> takeFrame(bool keysWait = false);
    bool empty() const { return events_.empty(); }
    /// Whether a button, a wheel or a key that was not held down already waits.
    bool isUrgent() const;

private:
    std::deque<InputEvent> events_;
};

} // namespace tessera::viewer
