#pragma once
#include "viewer/session/Preferences.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// Begins with what is remembered of the window's own state. Looks begin with theirs (ViewerOptions::lookOf).
void recall(const Preferences& preferences, State& state);

/// Takes into the preferences what was chosen of a look that began as `begun`, in so far as that is remembered.
void rememberLook(Preferences& preferences, const Look& look, const Look& begun);

/// Takes into the preferences what the state holds that is worth keeping, where it is something else than the window
/// began with: what was said on the command line once, what a scene wishes and what the latest technique cannot do
/// leave in peace what was remembered. `begun` is the look that the open scene began with.
void remember(Preferences& preferences, const State& state, const Look& begun, glm::ivec2 windowSize);

} // namespace tessera::viewer
