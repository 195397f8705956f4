#pragma once
#include "viewer/session/State.h"

/// Edits of which lights there are, as far as they concern which one is selected and which one shines alone. Without a
/// scene they do nothing.
namespace tessera::viewer {

/// Deletes the selected light, if there is one; none is selected then.
void deleteSelectedLight(State& state);

/// Puts the lights that State::scatter describes in the place of the scene's, which bringBackReplaced() can bring back:
/// the ones that the user made or edited last. The next time the scattered ones lie elsewhere. Traces
/// rays at the scene's surfaces, which may take seconds. Throws std::runtime_error when memory runs out, and the lights
/// stay as they are.
void replaceByScattered(State& state);

/// Takes the scattered lights away again, with later edits of them.
void bringBackReplaced(State& state);

} // namespace tessera::viewer
