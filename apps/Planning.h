#pragma once
#include <string>
#include <vector>

#include "apps/Request.h"
#include "engine/Renderer.h"
#include "renderer/graph/Plan.h"

namespace tessera::app {

/// Options of `tessera plan` that affect the plan.
struct PlanningOptions {
    FrameOptions frame;
    std::vector<std::string> also; ///< cameras of further views
    bool measure = false;          ///< measures milliseconds; one view only
};

/// Throws InputError for options that allow no plan, whatever the scene.
void requirePlan(const PlanningOptions& options);

/// The plan of a resolved request. Throws InputError if the technique does not support the settings or the scene lacks
/// a camera.
graph::Plan planOf(const PlanningOptions& options, const Request& request);

/// Warns of given options that affect none of the views; see unusedSettings().
void warnOfPlan(const PlanningOptions& options, const Request& request);

/// planOf() with milliseconds, measured by a renderer of the request's scene.
graph::Plan measuredPlan(const Request& request, engine::Renderer& renderer, const gpu::Capabilities& gl);

} // namespace tessera::app
