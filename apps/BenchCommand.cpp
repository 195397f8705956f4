#include <fmt/format.h>

#include "apps/BenchRun.h"
#include "apps/Commands.h"
#include "apps/ErrorLine.h"
#include "apps/FrameOptionText.h"
#include "apps/Numbers.h"
#include "apps/OutputFolder.h"
#include "apps/Outputs.h"
#include "apps/Shard.h"
#include "apps/Version.h"
#include "base/Error.h"
#include "base/Names.h"
#include "engine/ChooseSamples.h"
#include "scenes/import/FileBytes.h"
#include "validation/bench/BenchReport.h"
#include "validation/bench/MachineName.h"
#include "validation/compare/ReferencePicture.h"

namespace tessera::app {

namespace {

constexpr const char* kReport = "/report.html";

struct BenchCommandOptions {
    FrameOptions frame;
    std::vector<std::string> scenes, merge;
    std::string folder, matrix, shard, against;
    std::optional<int> frames;
    bool resume = false;
};

struct NamedTruth {
    std::string_view name;
    validation::BenchTruth truth;
};
constexpr NamedTruth kTruths[] = {{"reference", validation::BenchTruth::Reference},
                                  {"forward", validation::BenchTruth::Forward}};

std::optional<validation::BenchTruth> benchTruthNamed(const std::string& name) {
    if (name.empty()) return {};
    std::vector<std::string_view> names;
    for (const NamedTruth& row : kTruths) {
        if (row.name == name) return row.truth;
        names.push_back(row.name);
    }
    throw InputError(
        fmt::format("--against '{}' is nothing that bench measures against: {}", name, suggestNames(name, names)));
}

validation::BenchMatrix matrixOf(const BenchCommandOptions& options) {
    if (options.matrix.empty()) return {};
    scenes::LoadLedger ledger(loadOptionsOf(options.frame).memoryLimitBytes);
    const std::vector<std::byte> bytes = scenes::readFileBytes(options.matrix, ledger);
    return validation::parseMatrix({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, options.matrix, ledger);
}

/// Everything that will be measured; names, and files against the outputs, are checked for every scene before the first
/// frame is drawn.
validation::BenchPlan planOf(const BenchCommandOptions& options, Outputs& outputs) {
    validation::BenchMatrix matrix = matrixOf(options);
    if (const auto technique = options.frame.said("technique"); technique && matrix.techniques.empty())
        matrix.techniques.push_back(techniqueNamed(*technique));
    validation::BenchPlan plan;
    for (const std::string& scene : options.scenes) {
        FrameOptions frame = options.frame;
        frame.scene = scene;
        const Request request = resolve(frame);
        outputs.reads(request.files);
        const frame::FrameSettings& settings = request.settings;
        requireLitPicture(settings, "bench");
        if (settings.samples != 1) throw InputError("bench measures frames of one sample a pixel; give --samples 1");
        if (benchTruthNamed(options.against) == validation::BenchTruth::Reference)
            validation::requireReferenceTakes(settings);
        validation::addToPlan(plan, matrix, scene, options.frame.lights, settings, [&](std::optional<int> lights) {
            frame.lights = lights;
            return loadFor(frame);
        });
    }
    if (plan.groups.empty())
        throw InputError("the matrix leaves nothing to measure: no technique takes any of its culling methods");
    return plan;
}

std::string commandOf(const BenchCommandOptions& options) {
    std::string command = "tessera bench";
    for (const std::string& scene : options.scenes) command += " " + shellWord(scene);
    command += " -o " + shellWord(options.folder) + frameOptionText(options.frame);
    if (!options.matrix.empty()) command += " --matrix " + shellWord(options.matrix);
    if (!options.against.empty()) command += " --against " + options.against;
    if (options.frames) command += fmt::format(" --frames {}", *options.frames);
    if (!options.shard.empty()) command += " --shard " + options.shard;
    return command;
}

Outputs outputsOf(const BenchCommandOptions& options) {
    Outputs outputs({options.folder + kReport});
    addBenchFiles(options.folder, outputs);
    if (!options.matrix.empty()) outputs.reads({options.matrix});
    for (const std::string& shard : options.merge) outputs.reads({shard + "/parts/run.json"});
    return outputs;
}

void write(const Outputs& outputs, const std::string& folder, const validation::BenchRecord& record) {
    writeBenchFiles(outputs, folder, record);
    outputs.write(folder + kReport, validation::reportHtml(validation::benchReport(record, folder)));
}

int finish(const Outputs& outputs, const std::string& folder, const validation::BenchRecord& record) {
    write(outputs, folder, record);
    fmt::print("{}report    {}{}\n", validation::benchTable(record), folder, kReport);
    for (const validation::BenchGroup& group : record.groups) {
        for (const validation::BenchResult& result : group.results) {
            if (result.counters.falseNegatives == 0) continue;
            printProblem(fmt::format("{} misses {} lights that pixels need", validation::pointName(result.key),
                                     result.counters.falseNegatives));
            return kToleranceMissed;
        }
    }
    return kGood;
}

int merge(const BenchCommandOptions& options) {
    if (!options.scenes.empty() || !options.matrix.empty() || !options.shard.empty() || options.resume)
        throw InputError("--merge puts finished shards together and measures nothing: leave scenes, --matrix, --shard "
                         "and --resume out");
    requireFolderPlace(options.folder);
    const Outputs outputs = outputsOf(options);
    const validation::FolderLock lock = validation::mergeRuns(options.merge, options.folder);
    return finish(outputs, options.folder, validation::recordIn(options.folder));
}

int bench(const BenchCommandOptions& options, const GlobalOptions& global) {
    if (!options.merge.empty()) return merge(options);
    if (options.scenes.empty())
        throw InputError("bench needs a SCENE to measure, or --merge with the folders of finished shards");
    requireFolderPlace(options.folder);
    Outputs outputs = outputsOf(options);
    BenchRun run;
    run.options.against = benchTruthNamed(options.against);
    if (options.frames) run.options.frames = *options.frames;
    if (run.options.frames < 1) throw InputError(fmt::format("--frames {} is less than one frame", run.options.frames));
    const auto [shard, shards] = shardNamed(options.shard);
    run.plan = planOf(options, outputs);
    if (options.frame.said("filter")) run.options.errorFilter = run.plan.groups.front().points.front().settings.filter;
    const std::unique_ptr<gpu::Context> context = makeContext(global);
    for (validation::PlannedGroup& group : run.plan.groups) {
        group.settings = engine::settingsOn(context->capabilities(), group.settings);
        for (validation::BenchPoint& point : group.points)
            point.settings = engine::settingsOn(context->capabilities(), point.settings);
    }
    const validation::RunIdentity identity{validation::machineName(),
                                           context->capabilities().renderer,
                                           kCommit,
                                           frameOptionText(options.frame),
                                           options.against,
                                           run.options.frames,
                                           shard,
                                           shards,
                                           commandOf(options)};
    run.load = [&](const validation::PlannedGroup& group) {
        FrameOptions frame = options.frame;
        frame.scene = group.scene;
        frame.lights = group.lightsToLoad;
        return loadFor(frame);
    };
    run.write = [&](const validation::BenchRecord& record) { write(outputs, options.folder, record); };
    makeFolder(options.folder);
    const validation::BenchStore store(options.folder, identity, run.plan,
                                       options.resume ? validation::EarlierRun::Resume : validation::EarlierRun::Keep);
    return finish(outputs, options.folder, runBench(*context, store, std::move(run), global.quiet));
}

} // namespace

void addBenchCommand(CLI::App& app, const GlobalOptions& global, Run& run) {
    CLI::App* command =
        app.add_subcommand("bench", "Error against run time: measures techniques in turn and says which one to take");
    auto options = std::make_shared<BenchCommandOptions>();
    command->add_option("scenes", options->scenes, "Scenes to measure, files or built-in ones (tessera scenes)")
        ->type_name("SCENE");
    addFrameSettings(*command, options->frame);
    command->get_option("--technique")->description("Measures this technique alone [all]");
    command
        ->add_option("-o,--output", options->folder,
                     "Folder for bench.json, bench.csv and report.html; made where it is missing")
        ->type_name("DIR")
        ->required();
    command
        ->add_option("--matrix", options->matrix,
                     "JSON object of arrays: " + validation::matrixKeys() + "; every combination is measured")
        ->type_name("FILE");
    command
        ->add_option("--against", options->against,
                     "What errors are measured against: reference or forward [reference where it takes seconds]")
        ->type_name("NAME");
    addWholeNumber(*command, "--frames", options->frames, "Frames of each point that are timed [20]", "N");
    command->add_flag("--resume", options->resume, "Goes on where a run in DIR was interrupted");
    command->add_option("--shard", options->shard, "Measures part I of N, whole groups of points")->type_name("I/N");
    command->add_option("--merge", options->merge, "Puts finished shards together in the output folder")
        ->type_name("DIR")
        ->expected(1, -1);
    command->footer(R"(Examples
  tessera bench hall -o out                             every technique and culling method
  tessera bench lattice -o out --lights 1024 --frames 5 a quick look at many lights
  tessera bench lattice -o out --matrix matrix.json     with {"tile": [8, 16, 32], "lights": [256, 1024]}
  tessera bench head -o out --shadows all --matrix m.json with {"shadow": ["traced", "pcf"], "shadowWidth": [3, 5]}
  tessera bench hall -o out --resume                    after an interruption: nothing is measured twice
  tessera bench -o all --merge part1 part2              shards 1/2 and 2/2 put together

Points of one scene, light count and size take turns, so that all of them meet the same machine.)");
    command->callback([options, &global, &run] { run = [options, &global] { return bench(*options, global); }; });
}

} // namespace tessera::app
