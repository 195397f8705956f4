#include "apps/BenchRun.h"

#include "apps/OutputFolder.h"
#include "apps/Progress.h"
#include "validation/AtomicFile.h"

namespace tessera::app {

using validation::GroupState;

void writeBenchFiles(const std::string& folder, const validation::BenchRecord& record) {
    validation::writeFileAtomically(folder + "/bench.json", validation::benchJson(record));
    validation::writeFileAtomically(folder + "/bench.csv", validation::benchCsv(record));
}

validation::BenchRecord runBench(gpu::Context& context, BenchRun run, bool quiet) {
    makeFolder(run.folder);
    const validation::BenchStore store(run.folder, run.identity, run.plan, run.resume);
    const std::vector<validation::PlannedGroup>& groups = run.plan.groups;
    std::vector<GroupState> states(groups.size());
    std::size_t steps = 0;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        if (!store.isOfShard(i)) continue;
        states[i] = store.load(i);
        steps += validation::stepsOf(groups[i], states[i], run.options);
    }
    Progress progress("measuring", steps, quiet);
    run.options.progress = [&progress](std::size_t done) { progress.advance(done); };
    for (std::size_t i = 0; i < groups.size(); ++i) {
        if (!store.isOfShard(i) || states[i].isDone) continue;
        run.options.keep = [&](const GroupState& state) { store.keep(i, state); };
        run.options.keepPicture = [&](const std::string& name, const validation::DisplayImage& image) {
            return store.keepPicture(i, name, image);
        };
        validation::measureGroup(context, run.load(groups[i]), groups[i], run.options, states[i]);
        run.write(validation::recordIn(run.folder));
    }
    progress.finish();
    return validation::recordIn(run.folder);
}

} // namespace tessera::app
