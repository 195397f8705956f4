#pragma once
#include "viewer/session/State.h"

/// Edits of which lights there are, as far as they concern which one is selected and which one shines alone. Without a
/// scene they do nothing.
namespace tessera::viewer {

/// Deletes the selected light, if there is one; none is selected then.
void deleteSelectedLight(State& state);

/// Puts the lights that State::scatter describes in the place of the scene's. The next time they lie elsewhere. Traces
/// rays at the scene's surfaces, which may take seconds. Throws std::runtime_error when memory runs out, and the lights
/// stay as they are.
void replaceByScattered(State& state);

} // namespace tessera::viewer
