#pragma once
#include "apps/Request.h"
#include "engine/Renderer.h"

namespace tessera::app {

/// Filters the environment beforehand where frames of the request look it up, and hands it to the renderer. This takes
/// seconds the first time that a map is used. Unless `quiet`, a line on stderr says so before it begins, and a progress
/// bar follows where that is a terminal.
void filterEnvironment(const Request& request, engine::Renderer& renderer, bool quiet);

} // namespace tessera::app
