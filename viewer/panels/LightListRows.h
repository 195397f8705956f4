#pragma once
#include "viewer/session/State.h"

namespace tessera::viewer {

/// The scene's lights as rows that can be searched, ordered, grouped, chosen and renamed.
void lightList(State& state);

} // namespace tessera::viewer
