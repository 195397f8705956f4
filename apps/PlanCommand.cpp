#include <fmt/format.h>

#include "apps/Commands.h"
#include "apps/Outputs.h"
#include "apps/Planning.h"
#include "base/Error.h"
#include "scenes/Defaults.h"

namespace tessera::app {

namespace {

struct PlanOptions : PlanningOptions {
    std::string json, dot;
};

int plan(const PlanOptions& options, const GlobalOptions& global) {
    const bool printsJson = isStandardOutput(options.json), printsDot = isStandardOutput(options.dot);
    if (printsJson && printsDot)
        throw InputError("--json - and --dot - both name the standard output; name a file for one of them");
    requirePlan(options);
    for (const std::string& path : {options.json, options.dot})
        if (!path.empty()) requireOutput(path);
    Outputs outputs({options.json, options.dot});
    const Request request = resolve(options.frame);
    outputs.reads(request.files);
    engine::requireSupported(request);
    warnOfPlan(options, request);
    const auto measured = [&] {
        const std::unique_ptr<gpu::Context> context = makeContext(global);
        engine::Renderer renderer(*context, request.scene);
        return measuredPlan(request, renderer, context->capabilities());
    };
    const graph::Plan plan = options.measure ? measured() : planOf(options, request);
    if (!options.json.empty()) outputs.write(options.json, graph::planJson(plan));
    if (!options.dot.empty()) outputs.write(options.dot, graph::planDot(plan));
    if (printsJson || printsDot) return kGood;
    if (const std::string supplied = scenes::suppliedText(request.scene); !supplied.empty() && !global.quiet)
        fmt::print("{}\n", supplied);
    if (const std::string cameras = camerasText(options.frame, request); !cameras.empty() && !global.quiet)
        fmt::print("{}\n", cameras);
    fmt::print("{}", graph::planText(plan));
    return kGood;
}

} // namespace

void addPlanCommand(CLI::App& app, const GlobalOptions& global, Run& run) {
    CLI::App* command =
        app.add_subcommand("plan", "Prints what a frame runs, what it leaves out and why, and what it costs");
    auto options = std::make_shared<PlanOptions>();
    addFrameOptions(*command, options->frame, "");
    command->add_option("--json", options->json, "Writes the plan as JSON; - prints it alone")->type_name("FILE");
    command->add_option("--dot", options->dot, "Writes the graph for Graphviz (dot -Tsvg FILE); - prints it alone")
        ->type_name("FILE");
    command
        ->add_option("--also", options->also, "Adds a view from that camera of the scene to the frame; may be repeated")
        ->type_name("CAMERA")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->add_flag("--measure", options->measure,
                      "Draws frames, which adds milliseconds and the memory of light lists");
    command->footer(R"(Examples
  tessera plan hall                                     passes, what is left out and why, memory
  tessera plan hall --technique forward --measure       with milliseconds
  tessera plan spheres --also 1                         a frame of two views, and its memory
  tessera plan hall --dot hall.dot; dot -Tsvg -O hall.dot)");
    command->callback([options, &global, &run] { run = [options, &global] { return plan(*options, global); }; });
}

} // namespace tessera::app
