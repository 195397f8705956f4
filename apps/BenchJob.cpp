#include "apps/BenchJob.h"

#include <utility>

#include <fmt/format.h>

#include "apps/FrameOptionText.h"
#include "apps/Version.h"
#include "base/Error.h"
#include "base/Names.h"
#include "engine/ChooseSamples.h"
#include "validation/bench/MachineName.h"
#include "validation/compare/ReferencePicture.h"

namespace tessera::app {

namespace {

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

/// Plans the measurements of all scenes. Names, and input files against the outputs, are checked before the first frame
/// is drawn.
validation::BenchPlan planOfJob(const BenchJobOptions& options, validation::BenchMatrix matrix,
                                const std::function<void(const std::vector<std::string>&)>& reads) {
    if (const auto technique = options.frame.said("technique"); technique && matrix.techniques.empty())
        matrix.techniques.push_back(techniqueNamed(*technique));
    validation::BenchPlan plan;
    for (const std::string& scene : options.scenes) {
        FrameOptions frame = options.frame;
        frame.scene = scene;
        const Request request = resolve(frame);
        reads(request.files);
        const frame::FrameSettings& settings = request.settings;
        requireLitPicture(settings, "bench");
        if (settings.samples != 1) throw InputError("bench measures frames of one sample a pixel; give --samples 1");
        if (benchTruthNamed(options.against) == validation::BenchTruth::Reference)
            validation::requireReferenceSupports(settings);
        validation::addToPlan(plan, matrix, scene, options.frame.lights, settings, [&](std::optional<int> lights) {
            frame.lights = lights;
            return loadFor(frame);
        });
    }
    if (plan.groups.empty())
        throw InputError("the matrix leaves nothing to measure: no technique takes any of its culling methods");
    return plan;
}

} // namespace

BenchRun benchRunOf(const BenchJobOptions& options, validation::BenchMatrix matrix,
                    const std::function<void(const std::vector<std::string>& files)>& reads) {
    BenchRun run;
    run.options.against = benchTruthNamed(options.against);
    if (options.frames) run.options.frames = *options.frames;
    if (run.options.frames < 1) throw InputError(fmt::format("--frames {} is less than one frame", run.options.frames));
    run.plan = planOfJob(options, std::move(matrix), reads);
    if (options.frame.said("filter")) run.options.errorFilter = run.plan.groups.front().points.front().settings.filter;
    run.load = [frame = options.frame](const validation::PlannedGroup& group) {
        FrameOptions one = frame;
        one.scene = group.scene;
        one.lights = group.lightsToLoad;
        return loadFor(one);
    };
    return run;
}

void settleOn(const gpu::Capabilities& gl, validation::BenchPlan& plan) {
    for (validation::PlannedGroup& group : plan.groups) {
        group.settings = engine::settingsOn(gl, group.settings);
        for (validation::BenchPoint& point : group.points) point.settings = engine::settingsOn(gl, point.settings);
    }
}

validation::RunIdentity identityOf(const BenchJobOptions& options, const gpu::Capabilities& gl, const BenchRun& run) {
    validation::RunIdentity identity;
    identity.machine = validation::machineName();
    identity.renderer = gl.renderer;
    identity.driver = gl.version;
    identity.commit = kCommit;
    identity.settings = frameOptionText(options.frame);
    identity.against = options.against;
    identity.frames = run.options.frames;
    return identity;
}

} // namespace tessera::app
