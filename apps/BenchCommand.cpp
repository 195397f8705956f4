#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "apps/Commands.h"
#include "apps/Numbers.h"
#include "apps/OutputFolder.h"
#include "apps/Progress.h"
#include "apps/Version.h"
#include "scenes/Error.h"
#include "validation/AtomicFile.h"
#include "validation/BenchRecord.h"

namespace tessera::app {

namespace {

struct BenchCommandOptions {
    FrameOptions frame;
    std::vector<std::string> scenes;
    std::string folder, matrix;
    std::optional<int> frames;
};

validation::BenchMatrix matrixOf(const BenchCommandOptions& options) {
    if (options.matrix.empty()) return {};
    std::ifstream file(options.matrix);
    if (!file) throw InputError(fmt::format("{}: cannot be read; --matrix names a JSON file", options.matrix));
    const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    return validation::parseMatrix(text, options.matrix);
}

/// Everything that will be measured; names are checked against every scene before the first frame is drawn.
validation::BenchPlan planOf(const BenchCommandOptions& options, const GlobalOptions&) {
    validation::BenchMatrix matrix = matrixOf(options);
    if (matrix.techniques.empty() && options.frame.technique)
        matrix.techniques.push_back(techniqueNamed(*options.frame.technique));
    validation::BenchPlan plan;
    for (const std::string& scene : options.scenes) {
        FrameOptions frame = options.frame;
        frame.scene = scene;
        const Request request = resolve(frame);
        validation::BenchPlan points = validation::planBench(matrix, scene, options.frame.lights, request.settings);
        plan.points.insert(plan.points.end(), points.points.begin(), points.points.end());
        if (plan.skipped.empty()) plan.skipped = std::move(points.skipped);
    }
    if (plan.points.empty())
        throw InputError("the matrix leaves nothing to measure: no technique takes any of its culling methods");
    return plan;
}

std::size_t groupCount(const std::vector<validation::BenchPoint>& points) {
    std::size_t count = 0;
    for (std::size_t first = 0; first < points.size(); first = validation::groupEnd(points, first)) ++count;
    return count;
}

int bench(const BenchCommandOptions& options, const GlobalOptions& global) {
    if (options.frame.samples.value_or(1) != 1)
        throw InputError("bench measures frames of one sample a pixel; leave --samples out");
    requireFolderPlace(options.folder);
    validation::BenchOptions run;
    if (options.frames) run.frames = *options.frames;
    if (run.frames < 1) throw InputError(fmt::format("--frames {} is less than one frame", run.frames));
    const validation::BenchPlan plan = planOf(options, global);
    const std::unique_ptr<gpu::Context> context = makeContext(global);

    validation::BenchRecord record;
    record.machine = validation::machineName();
    record.renderer = context->capabilities().renderer;
    record.commit = kCommit;
    record.skipped = plan.skipped;
    makeFolder(options.folder);
    Progress progress("measuring", validation::benchRounds(run, groupCount(plan.points)), global.quiet);
    run.progress = [&progress] { progress.advance(); };
    for (std::size_t first = 0; first < plan.points.size();) {
        const std::size_t end = validation::groupEnd(plan.points, first);
        FrameOptions frame = options.frame;
        frame.scene = plan.points[first].scene;
        frame.lights = plan.points[first].lights;
        const scenes::Scene scene = loadFor(frame);
        record.groups.push_back(
            validation::benchGroup(*context, scene, std::span(plan.points).subspan(first, end - first), run));
        record.recommendation = validation::recommend(record.groups);
        // Written after every group, so that an interrupted run keeps what it has.
        validation::writeFileAtomically(options.folder + "/bench.json", validation::benchJson(record));
        first = end;
    }
    progress.finish();
    fmt::print("{}", validation::benchTable(record));
    for (const validation::BenchGroup& group : record.groups) {
        for (const validation::BenchResult& result : group.results) {
            if (result.counters.falseNegatives == 0) continue;
            fmt::print(stderr, "tessera: {} misses {} lights that pixels need\n", validation::pointName(result.point),
                       result.counters.falseNegatives);
            return kToleranceMissed;
        }
    }
    return kGood;
}

} // namespace

void addBenchCommand(CLI::App& app, const GlobalOptions& global, Run& run) {
    CLI::App* command = app.add_subcommand(
        "bench", "Measures techniques and culling methods in turn, against the floor that none can go below");
    auto options = std::make_shared<BenchCommandOptions>();
    command->add_option("scenes", options->scenes, "Scenes to measure, files or built-in ones (tessera scenes)")
        ->type_name("SCENE")
        ->required();
    addFrameSettings(*command, options->frame);
    command->add_option("-o,--output", options->folder, "Folder for bench.json; made where it is missing")
        ->type_name("DIR")
        ->required();
    command
        ->add_option(
            "--matrix", options->matrix,
            "JSON object of arrays: technique, culling, tile, layout, lights, size; every combination is measured")
        ->type_name("FILE");
    addWholeNumber(*command, "--frames", options->frames, "Frames of each point that are timed [20]", "N");
    command->footer(R"(Examples
  tessera bench hall -o out                             every technique and culling method
  tessera bench lattice -o out --lights 1024 --frames 5 a quick look at many lights
  tessera bench lattice -o out --matrix matrix.json     with {"tile": [8, 16, 32], "lights": [256, 1024]})");
    command->callback([options, &global, &run] { run = [options, &global] { return bench(*options, global); }; });
}

} // namespace tessera::app
