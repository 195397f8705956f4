#include <cmath>

#include <fmt/format.h>

#include "apps/Commands.h"
#include "apps/Outputs.h"
#include "apps/Progress.h"
#include "apps/Shard.h"
#include "base/Error.h"
#include "validation/stress/StressRecord.h"

namespace tessera::app {

namespace {

struct StressOptions {
    std::vector<std::string> cases;
    std::string techniques, json, shard;
    bool quick = false, list = false;
};

/// Steps of the progress bar; all cases have equal weight.
constexpr std::size_t kSteps = 1000;

/// The shard's part of the requested cases: every Nth.
std::vector<const validation::StressCase*> casesOf(const StressOptions& options) {
    const Shard shard = shardNamed(options.shard);
    std::vector<const validation::StressCase*> cases;
    if (options.cases.empty())
        for (const validation::StressCase& row : validation::stressCases()) cases.push_back(&row);
    for (const std::string& name : options.cases)
        for (const validation::StressCase* row : validation::stressCasesNamed(name)) cases.push_back(row);
    if (cases.size() < std::size_t(shard.count))
        throw InputError(fmt::format("--shard {}: of more shards than there are cases, {}; give fewer", options.shard,
                                     cases.size()));
    std::vector<const validation::StressCase*> part;
    for (std::size_t i = 0; i < cases.size(); ++i)
        if (shard.has(i)) part.push_back(cases[i]);
    return part;
}

std::vector<engine::Technique> techniquesOf(const StressOptions& options) {
    std::vector<engine::Technique> techniques;
    if (options.techniques.empty())
        for (const engine::TechniqueInfo& info : engine::techniqueTable()) techniques.push_back(info.technique);
    std::string names = options.techniques;
    while (!names.empty()) {
        const std::size_t end = std::min(names.find(','), names.size());
        techniques.push_back(techniqueNamed(names.substr(0, end)));
        names.erase(0, end + 1);
    }
    return techniques;
}

int stress(const StressOptions& options, const GlobalOptions& global) {
    if (options.list) {
        fmt::print("{}", validation::stressList());
        return kGood;
    }
    validation::StressRequest request;
    request.cases = casesOf(options);
    request.techniques = techniquesOf(options);
    request.effort = options.quick ? validation::StressEffort::Quick : validation::StressEffort::Full;
    if (!options.json.empty()) requireOutput(options.json);
    const Outputs outputs({options.json});
    const std::unique_ptr<gpu::Context> context = makeContext(global);
    Progress progress("stress", kSteps, global.quiet);
    std::size_t done = 0;
    request.progress = [&](double share) {
        const auto now = std::size_t(std::floor(share * double(kSteps)));
        if (now <= done) return;
        progress.advance(now - done);
        done = now;
    };
    validation::StressRecord record{context->capabilities().renderer, request.effort, {}};
    record.results = validation::runStress(*context, request);
    progress.finish();
    if (!options.json.empty()) outputs.write(options.json, validation::stressJson(record));
    if (!isStandardOutput(options.json)) fmt::print("{}", validation::stressTable(record));
    return record.ok() ? kGood : kToleranceMissed;
}

} // namespace

void addStressCommand(CLI::App& app, const GlobalOptions& global, Run& run) {
    CLI::App* command = app.add_subcommand(
        "stress", "Runs the stability suite: extremes of materials, lights, scenes and pictures against the truth");
    auto options = std::make_shared<StressOptions>();
    command->add_option("--case", options->cases, "Only this case, or this group of cases; may be given again [all]")
        ->type_name("NAME");
    command->add_option("--techniques,--technique", options->techniques, "Techniques that draw pictures [all]")
        ->type_name("A,B");
    command->add_option("--json", options->json, "Writes the figures as JSON; - prints them alone")->type_name("FILE");
    command->add_flag("--quick", options->quick, "Fewer samples and lights: some seconds instead of minutes");
    command->add_option("--shard", options->shard, "Runs part I of N, every Nth case")->type_name("I/N");
    command->add_flag("--list", options->list, "Lists the cases and what each holds, and runs nothing");
    command->footer(R"(Examples
  tessera stress --quick                                a short form of every case
  tessera stress --case directions                      one group of cases
  tessera stress --case scene/far --technique deferred  one case with one technique
  tessera stress --json stress.json                     everything, over 10 million samples
  tessera stress --shard 1/4 --json part1.json          the first of four parts

Exit code 3 says that a case did not hold.)");
    command->callback([options, &global, &run] { run = [options, &global] { return stress(*options, global); }; });
}

} // namespace tessera::app
