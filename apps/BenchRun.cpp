#include "apps/BenchRun.h"

#include <fmt/format.h>

#include "apps/Progress.h"
#include "base/Error.h"
#include "scenes/Fingerprint.h"

namespace tessera::app {

using validation::GroupState;

namespace {

constexpr const char *kJson = "/bench.json", *kCsv = "/bench.csv";

/// Loads the scene of a group. Throws InputError if its file was edited since the plan was made, maybe hours ago.
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

std::size_t stepsOf(const gpu::Capabilities& gl, const validation::BenchStore& store, const BenchRun& run) {
    std::size_t steps = 0;
    for (std::size_t i = 0; i < run.plan.groups.size(); ++i)
        if (store.isOfShard(i)) steps += validation::stepsOf(gl, run.plan.groups[i], store.load(i), run.options);
    return steps;
}

validation::BenchRecord measureMissing(gpu::Context& context, const validation::BenchStore& store, BenchRun run) {
    const std::vector<validation::PlannedGroup>& groups = run.plan.groups;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        if (!store.isOfShard(i)) continue;
        GroupState state = store.load(i);
        if (state.isDone) continue;
        run.options.keep = [&](const GroupState& now) { store.keep(i, now); };
        run.options.keepPicture = [&](const std::string& name, const DisplayImage& image) {
            return store.keepPicture(i, name, image);
        };
        validation::measureGroup(context, loadAsPlanned(run, groups[i]), groups[i], run.options, state);
        run.write(validation::recordIn(store.folder()));
    }
    return validation::recordIn(store.folder());
}

validation::BenchRecord runBench(gpu::Context& context, const validation::BenchStore& store, BenchRun run, bool quiet) {
    Progress progress("measuring", stepsOf(context.capabilities(), store, run), quiet);
    run.options.progress = [&progress](std::size_t done) { progress.advance(done); };
    return measureMissing(context, store, std::move(run));
}

} // namespace tessera::app
