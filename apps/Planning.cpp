#include "apps/Planning.h"

#include <algorithm>
#include <optional>

#include <spdlog/spdlog.h>

#include "base/Error.h"
#include "engine/ChooseSamples.h"
#include "engine/PrepareView.h"
#include "validation/compare/Measure.h"

namespace tessera::app {

void requirePlan(const PlanningOptions& options) {
    if (options.measure && !options.also.empty())
        throw InputError("--measure times a frame of one view; leave --also out");
    if (options.frame.said("technique") == kReferenceName)
        throw InputError("the reference has no plan: it follows a ray a pixel in double precision, without passes and "
                         "without OpenGL; give another technique");
}

namespace {

std::vector<engine::ViewRequest> viewsOf(const PlanningOptions& options, const Request& request) {
    std::vector<engine::ViewRequest> views{request};
    for (const std::string& camera : options.also) {
        views.push_back(request);
        engine::settingOf("camera").read(views.back(), camera, {"--also", &request.scene});
    }
    return views;
}

} // namespace

graph::Plan planOf(const PlanningOptions& options, const Request& request) {
    engine::requireSupported(request);
    const std::vector<engine::ViewRequest> views = viewsOf(options, request);
    return views.size() > 1 ? engine::planViews(request.scene, views)
                            : engine::planFrame(request.scene, request.technique, request.settings);
}

void warnOfPlan(const PlanningOptions& options, const Request& request) {
    std::optional<std::vector<std::string>> unused; // common to all views
    for (const engine::ViewRequest& view : viewsOf(options, request)) {
        const std::vector<std::string> own =
            unusedSettings(options.frame, request, engine::prepareView(request.scene, view.technique, view.settings),
                           {&view.technique, 1});
        if (!unused) unused = own;
        std::erase_if(*unused, [&](const std::string& text) { return std::ranges::find(own, text) == own.end(); });
    }
    for (const std::string& text : *unused) spdlog::warn("{}", text);
}

graph::Plan measuredPlan(const Request& request, engine::Renderer& renderer, const gpu::Capabilities& gl) {
    engine::requireSupported(request);
    const frame::FrameSettings settings = engine::settingsOn(gl, request.settings);
    graph::Plan plan = engine::planFrame(request.scene, request.technique, settings);
    validation::measurePlan(plan, renderer, request.technique, settings);
    return plan;
}

} // namespace tessera::app
