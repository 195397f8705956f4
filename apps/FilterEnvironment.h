#pragma once
#include "apps/Request.h"
#include "engine/Renderer.h"

namespace tessera::app {

/// Filters the environment beforehand where frames of the request look it up, and hands it to the renderer, with a
/// progress bar: it takes seconds the first time that a map is used.
void filterEnvironment(const Request& request, engine::Renderer& renderer, bool quiet);

} // namespace tessera::app
