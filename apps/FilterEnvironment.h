#pragma once
#include "apps/Request.h"
#include "engine/Renderer.h"

namespace tessera::app {

/// Filters the environment beforehand where frames of the request look it up, and hands it to the renderer. It takes
/// seconds the first time that a map is used, which unless `quiet` one line on stderr tells before them, also where
/// that is no terminal and no progress bar follows.
void filterEnvironment(const Request& request, engine::Renderer& renderer, bool quiet);

} // namespace tessera::app
