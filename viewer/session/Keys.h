#pragma once
#include <span>

#include "viewer/session/State.h"

namespace tessera::viewer {

/// A key and what it does: the one list that keyboard and help follow.
struct KeyBinding {
    int key;          ///< GLFW_KEY_*
    int modifiers;    ///< GLFW_MOD_SHIFT and GLFW_MOD_CONTROL that must be held
    const char* name; ///< as on the keyboard: "Ctrl+S"
    const char* meaning;
    void (*act)(State&);
    const char* group = nullptr; ///< of the help, which begins with this key
};
std::span<const KeyBinding> keyBindings();

/// Views along the axes of the world, about what the camera turns about.
struct AxisView {
    const char* name;
    const char* meaning;
    int key, padKey; ///< GLFW_KEY_*: with Ctrl, and that of the number pad
    Heading heading;
};
std::span<const AxisView> axisViews();

/// What the mouse does, and keys that are held; for the help.
struct GestureHelp {
    const char* name;
    const char* meaning;
};
std::span<const GestureHelp> gestureHelp();

/// Runs the action of a key; false if it has none.
bool pressKey(State& state, int key, int modifiers);

} // namespace tessera::viewer
