#include "python/Work.h"

#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/FilterEnvironment.h"
#include "apps/OnePicture.h"
#include "apps/Outputs.h"
#include "base/Error.h"
#include "base/OneLine.h"
#include "engine/PrepareView.h"
#include "engine/Rendering.h"
#include "scenes/LoadLedger.h"
#include "validation/compare/ReferencePicture.h"
#include "validation/pictures/ShownPicture.h"

namespace tessera::python {

namespace {

/// Unloads the scene if `work` fails in the driver: the next call then starts anew, without partly drawn data.
template <typename Work>
auto orDrop(SceneObject& scene, const Work& work) {
    try {
        return work();
    } catch (const InputError&) { // thrown before anything is drawn
        throw;
    } catch (...) {
        scene.drop();
        throw;
    }
}

void warnAbout(const std::string& what, const std::string& text) {
    if (!text.empty()) spdlog::warn("{}", oneLine(what + ": " + text));
}

/// The renderer of the loaded scene. Filters the environment if frames of the request sample it.
engine::Renderer& readyRenderer(LoadedScene& loaded, gpu::Context& context) {
    engine::Renderer& renderer = loaded.rendererOn(context);
    const bool looksUp =
        frame::makeFrameSpec(loaded.request.scene, {}, loaded.request.settings).usesFilteredEnvironment();
    if (looksUp && !std::exchange(loaded.hasFiltered, true)) app::filterEnvironment(loaded.request, renderer, true);
    return renderer;
}

Rendered renderReference(LoadedScene& loaded, const app::FrameOptions& options, Job& job) {
    app::Request& request = loaded.request;
    app::settleForReference(options, request.settings);
    for (const std::string& text : app::unusedByReference(options, request)) spdlog::warn("{}", text);
    job.expect(std::size_t(request.settings.sizePixels.y));
    const auto rowDone = [&job] { job.advance(); };
    constexpr auto kNone = validation::Alternatives::None;
    Rendered rendered;
    rendered.picture =
        request.scene.hook
            ? validation::referencePicture(loaded.rendererOn(Worker::get().context()), request.settings, rowDone, kNone)
                  .picture
            : validation::referencePicture(request.scene, request.settings, rowDone, kNone).picture;
    warnAbout(request.scene.name, app::faultOf(request.scene, request.settings.view, rendered.picture.rgba, ""));
    rendered.shown = engine::toDisplayImage(rendered.picture, request.settings);
    rendered.technique = app::kReferenceName;
    return rendered;
}

/// Renders a frame and counts diffused objects as steps of the job. The renderer outlives the job, so the callback is
/// removed even on exceptions.
engine::RenderedFrame renderReporting(engine::Renderer& renderer, const engine::ViewRequest& request, Job& job) {
    struct Reporting {
        engine::Renderer& renderer;
        ~Reporting() { renderer.reportDiffusion({}); }
    } const reporting{renderer};
    renderer.reportDiffusion([&job](std::size_t done, std::size_t objects) {
        if (done == 0)
            job.expect(objects);
        else
            job.advance();
    });
    return renderer.render(request.technique, request.settings);
}

Rendered renderByContext(LoadedScene& loaded, const app::FrameOptions& options, Job& job) {
    app::Request& request = loaded.request;
    engine::requireSupported(request);
    request.settings.display = true;
    engine::Renderer& renderer = readyRenderer(loaded, Worker::get().context());
    const engine::RenderedFrame frame = renderReporting(renderer, request, job);
    const engine::DrawnShadows shadows = renderer.shadows();
    const std::string& name = request.scene.name;
    warnAbout(name, renderer.missingTextures());
    warnAbout(name, renderer.invisibleDiffusion());
    warnAbout(name, app::faultOf(request.scene, request.settings.view, frame.radiance, shadows.cut));
    warnAbout(name, shadows.missing);
    for (const std::string& text :
         app::unusedSettings(options, request, engine::prepareView(request.scene, request.technique, request.settings),
                             {&request.technique, 1}))
        spdlog::warn("{}", text);
    Rendered rendered;
    rendered.picture = engine::toPicture(frame);
    rendered.shown = validation::shownPicture(frame, shadows, name, request.technique, request.settings.view);
    rendered.technique = infoOf(request.technique).name;
    return rendered;
}

} // namespace

Rendered render(SceneObject& scene, app::FrameOptions options, Job& job) {
    const bool isReference = options.said("technique") == app::kReferenceName;
    if (isReference) options.settings.erase("technique");
    LoadedScene& loaded = scene.resolved(options, job);
    return orDrop(scene, [&] {
        Rendered rendered = isReference ? renderReference(loaded, options, job) : renderByContext(loaded, options, job);
        rendered.scene = loaded.request.scene.name;
        rendered.view = frame::debugViewInfo(loaded.request.settings.view).name;
        return rendered;
    });
}

std::string compareJson(SceneObject& scene, const app::ComparisonOptions& options, Job& job) {
    validation::Truth truth = app::truthOf(options);
    LoadedScene& loaded = scene.resolved(options.frame, job);
    app::Comparison comparison = app::comparisonOf(options, loaded.request, std::move(truth));
    app::warnOfComparison(options, loaded.request, comparison);
    return orDrop(scene, [&] {
        gpu::Context& context = Worker::get().context();
        app::warnOfDriver(context.capabilities(), loaded.request, comparison);
        engine::Renderer& renderer = readyRenderer(loaded, context);
        job.expect(validation::stepCount(loaded.request.scene, comparison.request));
        comparison.request.renderedOne = [&job] { job.advance(); };
        return validation::compareJson(app::runComparison(renderer, context.capabilities(), comparison).record);
    });
}

std::string planJson(SceneObject& scene, const app::PlanningOptions& options, Job& job) {
    app::requirePlan(options);
    LoadedScene& loaded = scene.resolved(options.frame, job);
    engine::requireSupported(loaded.request);
    app::warnOfPlan(options, loaded.request);
    if (!options.measure) return graph::planJson(app::planOf(options, loaded.request));
    return orDrop(scene, [&] {
        gpu::Context& context = Worker::get().context();
        return graph::planJson(app::measuredPlan(loaded.request, loaded.rendererOn(context), context.capabilities()));
    });
}

std::string benchJson(const BenchRequest& request, Job& job) {
    validation::BenchMatrix matrix;
    if (!request.matrix.empty()) {
        scenes::LoadLedger ledger(app::loadOptionsOf(request.options.frame).memoryLimitBytes);
        matrix = validation::parseMatrix(request.matrix, "matrix", ledger);
    }
    app::Outputs outputs;
    app::addBenchFiles(request.folder, outputs);
    app::BenchRun run = app::benchRunOf(request.options, std::move(matrix),
                                        [&](const std::vector<std::string>& files) { outputs.reads(files); });
    gpu::Context& context = Worker::get().context();
    app::settleOn(context.capabilities(), run.plan);
    validation::RunIdentity identity = app::identityOf(request.options, context.capabilities(), run);
    identity.command = request.command;
    const validation::BenchStore store(request.folder, identity, run.plan,
                                       request.resumes ? validation::EarlierRun::Resume : validation::EarlierRun::Keep);
    run.write = [&](const validation::BenchRecord& record) { app::writeBenchFiles(outputs, request.folder, record); };
    run.options.progress = [&job](std::size_t steps) { job.advance(steps); };
    job.expect(app::stepsOf(context.capabilities(), store, run));
    const validation::BenchRecord record = app::measureMissing(context, store, std::move(run));
    app::writeBenchFiles(outputs, request.folder, record);
    return validation::benchJson(record);
}

SceneFacts load(SceneObject& scene, Job& job) {
    app::FrameOptions options = scene.options();
    if (options.said("technique") == app::kReferenceName) options.settings.erase("technique");
    return factsOf(scene.resolved(options, job).request);
}

} // namespace tessera::python
