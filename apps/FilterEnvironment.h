#pragma once
#include "apps/Request.h"
#include "engine/Renderer.h"

namespace tessera::app {

/// Prefilters the environment if frames of the request sample it, and passes it to the renderer. This takes seconds for
/// a map that is not in the cache. Unless `quiet`, prints a note on stderr first, and a progress bar if stderr is a
/// terminal.
void filterEnvironment(const Request& request, engine::Renderer& renderer, bool quiet);

} // namespace tessera::app
