#pragma once
#include "viewer/session/State.h"

namespace tessera::viewer {

/// The list of the scene's lights, with search, order, groups, selection and renaming.
void lightList(State& state);

} // namespace tessera::viewer
