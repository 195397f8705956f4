#pragma once
#include <string>
#include <vector>

#include "apps/Request.h"
#include "engine/Renderer.h"
#include "renderer/graph/Plan.h"

namespace tessera::app {

/// What of the options of `tessera plan` its contents depend on.
struct PlanningOptions {
    FrameOptions frame;
    std::vector<std::string> also; ///< cameras of further views
    bool measure = false;          ///< in milliseconds; of one view
};

/// Throws InputError for options of which no plan can be made, whatever the scene.
void requirePlan(const PlanningOptions& options);

/// The plan of a resolved request. Throws InputError where the technique does not take the settings, or a camera is
/// none of the scene.
graph::Plan planOf(const PlanningOptions& options, const Request& request);

/// Warns of options that were said and change nothing of any of the views, as unheededSettings() says.
void warnOfPlan(const PlanningOptions& options, const Request& request);

/// The same with its milliseconds, by a renderer of the request's scene.
graph::Plan measuredPlan(const Request& request, engine::Renderer& renderer, const gpu::Capabilities& gl);

} // namespace tessera::app
