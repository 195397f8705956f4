#include "apps/BenchRun.h"

#include <fmt/format.h>

#include "apps/Progress.h"
#include "base/Error.h"
#include "scenes/Fingerprint.h"

namespace tessera::app {

using validation::GroupState;

namespace {

constexpr const char *kJson = "/bench.json", *kCsv = "/bench.csv";

/// The scene of a group. Hours may lie between the plan and this, and its file may have been edited since.
scenes::Scene loadAsPlanned(const BenchRun& run, const validation::PlannedGroup& group) {
    scenes::Scene scene = run.load(group);
    if (scenes::fingerprint(scene) == group.fingerprint) return scene;
    throw InputError(fmt::format("{} changed while it was measured; bring it back and go on with --resume, or name "
                                 "another folder",
                                 group.scene));
}

} // namespace

void addBenchFiles(const std::string& folder, Outputs& outputs) {
    for (const char* file : {kJson, kCsv}) outputs.add(folder + file);
    outputs.addFolder(folder + "/parts");
}

void writeBenchFiles(const Outputs& outputs, const std::string& folder, const validation::BenchRecord& record) {
    outputs.write(folder + kJson, validation::benchJson(record));
    outputs.write(folder + kCsv, validation::benchCsv(record));
}

void requireLitPicture(const frame::FrameSettings& settings, const char* command) {
    if (settings.view == frame::DebugView::Final) return;
    const std::string_view name = frame::debugViewInfo(settings.view).name;
    throw InputError(fmt::format("--view {}: {} recommends a technique for the lit picture, and a view says nothing "
                                 "of it; leave --view out, or look at the view with tessera render --view {}",
                                 name, command, name));
}

validation::BenchRecord runBench(gpu::Context& context, const validation::BenchStore& store, BenchRun run, bool quiet) {
    const std::vector<validation::PlannedGroup>& groups = run.plan.groups;
    std::vector<GroupState> states(groups.size());
    std::size_t steps = 0;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        if (!store.isOfShard(i)) continue;
        states[i] = store.load(i);
        steps += validation::stepsOf(context.capabilities(), groups[i], states[i], run.options);
    }
    Progress progress("measuring", steps, quiet);
    run.options.progress = [&progress](std::size_t done) { progress.advance(done); };
    for (std::size_t i = 0; i < groups.size(); ++i) {
        if (!store.isOfShard(i) || states[i].isDone) continue;
        run.options.keep = [&](const GroupState& state) { store.keep(i, state); };
        run.options.keepPicture = [&](const std::string& name, const DisplayImage& image) {
            return store.keepPicture(i, name, image);
        };
        validation::measureGroup(context, loadAsPlanned(run, groups[i]), groups[i], run.options, states[i]);
        run.write(validation::recordIn(store.folder()));
    }
    progress.finish();
    return validation::recordIn(store.folder());
}

} // namespace tessera::app
