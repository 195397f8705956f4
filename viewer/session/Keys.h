#pragma once
#include <span>

#include "viewer/session/State.h"

namespace tessera::viewer {

/// A key and its action: the one table for the keyboard and the help.
struct KeyBinding {
    int key;          ///< GLFW_KEY_*
    int modifiers;    ///< GLFW_MOD_SHIFT and GLFW_MOD_CONTROL that must be held, and no others
    const char* name; ///< as on the keyboard: "Ctrl+S"
    const char* meaning;
    void (*act)(State&);
    const char* group = nullptr; ///< of the help, beginning with this key
};
std::span<const KeyBinding> keyBindings();

/// Views along the world axes, about the orbit pivot.
struct AxisView {
    const char* name;
    const char* meaning;
    int key, padKey; ///< GLFW_KEY_*: with Ctrl, and on the number pad
    Heading heading;
};
std::span<const AxisView> axisViews();

/// Mouse gestures and held keys, for the help.
struct GestureHelp {
    const char* name;
    const char* meaning;
};
std::span<const GestureHelp> gestureHelp();

/// Runs the action of a key; false if it has none.
bool pressKey(State& state, int key, int modifiers);

} // namespace tessera::viewer
