#include <fmt/format.h>

#include "apps/Commands.h"
#include "apps/Outputs.h"
#include "base/Error.h"
#include "engine/ChooseSamples.h"
#include "engine/Renderer.h"
#include "validation/compare/Measure.h"

namespace tessera::app {

namespace {

struct PlanOptions {
    FrameOptions frame;
    std::vector<std::string> also; ///< cameras of further views
    std::string json, dot;
    bool measure = false;
};

int plan(const PlanOptions& options, const GlobalOptions& global) {
    const bool printsJson = isStandardOutput(options.json), printsDot = isStandardOutput(options.dot);
    if (printsJson && printsDot)
        throw InputError("--json - and --dot - both ask for the standard output; name a file for one of them");
    if (options.measure && !options.also.empty())
        throw InputError("--measure times a frame of one view; leave --also out");
    if (options.frame.said("technique") == kReferenceName)
        throw InputError("the reference has no plan: it follows a ray a pixel in double precision, without passes and "
                         "without OpenGL; give another technique");
    for (const std::string& path : {options.json, options.dot})
        if (!path.empty()) requireOutput(path);
    Outputs outputs({options.json, options.dot});
    Request request = resolve(options.frame);
    outputs.reads(request.files);
    engine::requireTaken(request);
    std::vector<engine::ViewRequest> views{request};
    for (const std::string& camera : options.also) {
        views.push_back(request);
        engine::settingOf("camera").read(views.back(), camera, {"--also", &request.scene});
    }
    std::unique_ptr<gpu::Context> context;
    if (options.measure) {
        context = makeContext(global);
        request.settings = engine::settingsOn(context->capabilities(), request.settings);
    }
    graph::Plan plan = views.size() > 1 ? engine::planViews(request.scene, views)
                                        : engine::planFrame(request.scene, request.technique, request.settings);
    if (context) {
        engine::Renderer renderer(*context, request.scene);
        validation::measurePlan(plan, renderer, request.technique, request.settings);
    }
    if (!options.json.empty()) outputs.write(options.json, graph::planJson(plan));
    if (!options.dot.empty()) outputs.write(options.dot, graph::planDot(plan));
    if (!printsJson && !printsDot) fmt::print("{}", graph::planText(plan));
    return kGood;
}

} // namespace

void addPlanCommand(CLI::App& app, const GlobalOptions& global, Run& run) {
    CLI::App* command =
        app.add_subcommand("plan", "Tells what a frame runs, what it leaves out and why, and what it costs");
    auto options = std::make_shared<PlanOptions>();
    addFrameOptions(*command, options->frame, "");
    command->add_option("--json", options->json, "Writes the plan as JSON; - prints it alone")->type_name("FILE");
    command->add_option("--dot", options->dot, "Writes the graph for Graphviz (dot -Tsvg FILE); - prints it alone")
        ->type_name("FILE");
    command
        ->add_option("--also", options->also,
                     "Plans a frame of several views: one more, from that camera of the scene; may be repeated")
        ->type_name("CAMERA")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->add_flag("--measure", options->measure, "Draws frames to fill in milliseconds");
    command->footer(R"(Examples
  tessera plan hall                                     passes, what is left out and why, memory
  tessera plan hall --technique forward --measure       with milliseconds
  tessera plan spheres --also 1                         a frame of two views, and its memory
  tessera plan hall --dot hall.dot; dot -Tsvg -O hall.dot)");
    command->callback([options, &global, &run] { run = [options, &global] { return plan(*options, global); }; });
}

} // namespace tessera::app
