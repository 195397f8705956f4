#pragma once
#include "viewer/session/Preferences.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// Restores the window's own state from the preferences. ViewerOptions::lookOf restores looks.
void recall(const Preferences& preferences, State& state);

/// Saves the remembered settings of a look that the user changed since it began as `begun`.
void rememberLook(Preferences& preferences, const Look& look, const Look& begun);

/// Saves the remembered values of the state that differ from those the window began with. So values from the command
/// line, from a scene's options or adapted to the latest technique do not overwrite the saved ones. `begun` is the look
/// that the open scene began with.
void remember(Preferences& preferences, const State& state, const Look& begun, glm::ivec2 windowSize);

} // namespace tessera::viewer
