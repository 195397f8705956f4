#pragma once
#include "viewer/session/Preferences.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// Takes into the preferences what the state holds that is worth keeping. Of the look only what differs from `base`,
/// or was remembered before: the defaults and the wishes of scenes keep their say.
void remember(Preferences& preferences, const State& state, const Look& base);

} // namespace tessera::viewer
