#pragma once
#include "renderer/shader/ProgramLibrary.h"
#include "viewer/session/EventLog.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// Compiles the programs whose sources have changed, and shows their faults, or a notice of success. `isAsked`: by the
/// user, who learns too that nothing has changed.
void reloadShaders(shader::ProgramLibrary& library, State& state, const EventLog& log, bool isAsked);

} // namespace tessera::viewer
