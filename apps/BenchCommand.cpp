#include <algorithm>

#include <fmt/format.h>

#include "apps/BenchJob.h"
#include "apps/Commands.h"
#include "apps/ErrorLine.h"
#include "apps/FrameOptionText.h"
#include "apps/Numbers.h"
#include "apps/OutputFolder.h"
#include "apps/Outputs.h"
#include "apps/Shard.h"
#include "base/Error.h"
#include "scenes/import/Files.h"
#include "validation/bench/BenchMachines.h"
#include "validation/bench/BenchMerge.h"
#include "validation/bench/BenchReport.h"

namespace tessera::app {

namespace {

constexpr const char *kReport = "/report.html", *kMachines = "/machines.json";

struct BenchCommandOptions : BenchJobOptions {
    std::vector<std::string> merge;
    std::string folder, matrix, shard;
    bool resume = false;
};

validation::BenchMatrix matrixOf(const BenchCommandOptions& options) {
    if (options.matrix.empty()) return {};
    scenes::LoadLedger ledger(loadOptionsOf(options.frame).memoryLimitBytes);
    const std::vector<std::byte> bytes = scenes::readFileBytes(options.matrix, ledger);
    return validation::parseMatrix({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, options.matrix, ledger);
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

/// Exit code of the measurements: kToleranceMissed if culling missed lights that pixels need.
int verdict(const validation::BenchRecord& record) {
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

int finish(const Outputs& outputs, const std::string& folder, const validation::BenchRecord& record) {
    write(outputs, folder, record);
    fmt::print("{}report    {}{}\n", validation::benchTable(record), folder, kReport);
    return verdict(record);
}

/// Writes a report on all machines and one per machine.
int mergeMachines(const BenchCommandOptions& options, const std::vector<std::vector<std::string>>& shardsOfMachines) {
    Outputs outputs({options.folder + kReport, options.folder + kMachines});
    const auto folderOf = [&](std::size_t i) { return validation::machineFolder(options.folder, i); };
    for (std::size_t i = 0; i < shardsOfMachines.size(); ++i) {
        addBenchFiles(folderOf(i), outputs);
        outputs.add(folderOf(i) + kReport);
    }
    for (const std::string& shard : options.merge) outputs.reads({shard + "/parts/run.json"});
    const validation::FolderLock lock = validation::mergeMachines(shardsOfMachines, options.folder);
    std::vector<validation::MachineBench> machines;
    int code = kGood;
    for (std::size_t i = 0; i < shardsOfMachines.size(); ++i) {
        machines.push_back({folderOf(i).substr(options.folder.size() + 1), validation::recordIn(folderOf(i))});
        write(outputs, folderOf(i), machines.back().record);
    }
    outputs.write(options.folder + kMachines, validation::machinesJson(machines));
    outputs.write(options.folder + kReport, validation::reportHtml(validation::machinesReport(machines)));
    fmt::print("{}report    {}{}\n", validation::machinesTable(machines), options.folder, kReport);
    for (const validation::MachineBench& machine : machines) code = std::max(code, verdict(machine.record));
    return code;
}

int merge(const BenchCommandOptions& options) {
    if (!options.scenes.empty() || !options.matrix.empty() || !options.shard.empty() || options.resume)
        throw InputError("--merge puts finished shards together and measures nothing: leave scenes, --matrix, --shard "
                         "and --resume out");
    requireFolderPlace(options.folder);
    const std::vector<std::vector<std::string>> machines = validation::shardsByMachine(options.merge);
    if (machines.size() > 1) return mergeMachines(options, machines);
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
    const auto [shard, shards] = shardNamed(options.shard);
    const auto reads = [&](const std::vector<std::string>& files) { outputs.reads(files); };
    BenchRun run = benchRunOf(options, matrixOf(options), reads);
    const std::unique_ptr<gpu::Context> context = makeContext(global);
    settleOn(context->capabilities(), run.plan);
    validation::RunIdentity identity = identityOf(options, context->capabilities(), run);
    identity.shard = shard;
    identity.shards = shards;
    identity.command = commandOf(options);
    run.write = [&](const validation::BenchRecord& record) { write(outputs, options.folder, record); };
    makeFolder(options.folder);
    const validation::BenchStore store(options.folder, identity, run.plan,
                                       options.resume ? validation::EarlierRun::Resume : validation::EarlierRun::Keep);
    return finish(outputs, options.folder, runBench(*context, store, std::move(run), global.quiet));
}

} // namespace

void addBenchCommand(CLI::App& app, const GlobalOptions& global, Run& run) {
    CLI::App* command =
        app.add_subcommand("bench", "Error against run time: measures techniques in turn and recommends one");
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
    command
        ->add_option("--merge", options->merge,
                     "Puts finished shards together in the output folder; of several machines each gets a column")
        ->type_name("DIR")
        ->expected(1, -1);
    command->footer(R"(Examples
  tessera bench hall -o out                             every technique and culling method
  tessera bench lattice -o out --lights 1024 --frames 5 a quick look at many lights
  tessera bench lattice -o out --matrix matrix.json     with {"tile": [8, 16, 32], "lights": [256, 1024]}
  tessera bench head -o out --shadows all --matrix m.json with {"shadow": ["traced", "pcf"], "shadowWidth": [3, 5]}
  tessera bench hall -o out --resume                    after an interruption: nothing is measured twice
  tessera bench -o all --merge part1 part2              shards 1/2 and 2/2 put together
  tessera bench -o both --merge mine theirs             one run by two machines, a column each

Points of one scene, light count and size take turns, so that all of them meet the same machine.)");
    command->callback([options, &global, &run] { run = [options, &global] { return bench(*options, global); }; });
}

} // namespace tessera::app
