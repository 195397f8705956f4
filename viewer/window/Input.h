#pragma once
#include <deque>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace tessera::viewer {

/// An input event of the window system. Keys and buttons are GLFW's numbers.
struct InputEvent {
    enum class Kind { Move, Button, Scroll, Key, Character, Focus };
    Kind kind = Kind::Move;
    int code = 0;              ///< key, button or Unicode character
    bool down = false;         ///< of a key (also when it repeats), a button or the focus
    bool repeated = false;     ///< repeats while the key is held
    int modifiers = 0;         ///< GLFW_MOD_*
    glm::vec2 position{0.0f};  ///< of the pointer, screen coordinates from the upper left
    glm::vec2 scroll{0.0f};    ///< steps
    int letter = 0;            ///< of a key: its letter in the keyboard layout, 'A' to 'Z'; 0 for other keys
    double heardSeconds = 0.0; ///< arrival time from the window system, in Window::nowSeconds()
};

/// Queues events until a frame takes them, so that none is lost while a frame is drawn.
class InputQueue {
public:
    void push(const InputEvent& event);
    /// Takes the events of the next frame: as many as one frame of a user interface can represent. Such a frame has one
    /// pointer position, each button or key either down or up, constant Shift and Ctrl, and text before other keys. So
    /// it stops before an event that undoes an earlier one, before the pointer moves away from where a button changed,
    /// before a button is released at the end of a move, which a slider would miss, before Shift or Ctrl change after
    /// an event that they modify, and before text that was typed after a key such as Enter. With `keysWait` it also
    /// stops before the first key press.
    std::vector<InputEvent> takeFrame(bool keysWait = false);
    bool empty() const { return events_.empty(); }
    /// Whether a button, the wheel, or a key that is not repeating is pending.
    bool isUrgent() const;

private:
    std::deque<InputEvent> events_;
};

} // namespace tessera::viewer
