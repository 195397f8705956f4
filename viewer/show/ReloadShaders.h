#pragma once
#include "renderer/shader/ProgramLibrary.h"
#include "viewer/session/EventLog.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// Compiles the programs whose sources have changed, and shows their errors, or a notice of success. `isRequested`:
/// requested by the user, who is also notified if nothing has changed.
void reloadShaders(shader::ProgramLibrary& library, State& state, const EventLog& log, bool isRequested);

} // namespace tessera::viewer
