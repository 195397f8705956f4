#include <filesystem>

#include <fmt/format.h>

#include "apps/BenchRun.h"
#include "apps/Commands.h"
#include "apps/DemoBench.h"
#include "apps/FilterEnvironment.h"
#include "apps/FrameOptionText.h"
#include "apps/OutputFolder.h"
#include "apps/Outputs.h"
#include "apps/Progress.h"
#include "base/AtomicFile.h"
#include "base/Milliseconds.h"
#include "base/PictureFile.h"
#include "engine/ChooseSamples.h"
#include "engine/Renderer.h"
#include "renderer/graph/Plan.h"
#include "validation/bench/BenchHtml.h"
#include "validation/bench/BenchReport.h"
#include "validation/bench/Recommend.h"
#include "validation/compare/Measure.h"
#include "validation/compare/TechniqueCompare.h"
#include "validation/pictures/HeatMap.h"
#include "validation/report/FigureHtml.h"
#include "validation/report/Report.h"

namespace tessera::app {

namespace {

namespace fs = std::filesystem;
using engine::Technique;
using validation::CompareResult;

constexpr int kTimedFrames = 3;
/// One technique of each family, so that the demo stays short; the baseline first.
constexpr Technique kShown[] = {Technique::Forward, Technique::TiledDeferred, Technique::ForwardPlus,
                                Technique::ClusteredDeferred};

/// Technique that shows the packed layout: the fastest of kShown with a G-buffer.
constexpr Technique kPacked = Technique::TiledDeferred;

struct DemoOptions {
    FrameOptions frame;
    std::string folder = "out";
};

/// Results of a demo.
struct DemoResult {
    CompareResult comparison;
    std::vector<Technique> techniques;
    std::optional<validation::BenchRecord> bench; ///< only with one sample per pixel
    std::vector<double> ms;                       ///< per technique, only without a bench
    std::string choice;
    std::vector<Png> pictures; ///< of the comparison: the truth, then the compared images
    std::vector<Png> heatMaps; ///< per compared image
};

std::string choiceOf(const std::vector<Technique>& techniques, const std::vector<double>& ms, bool agree) {
    const std::size_t best = std::size_t(std::min_element(ms.begin(), ms.end()) - ms.begin());
    const std::string pace = best == 0 ? "the fastest here"
                                       : fmt::format("{:.1f}x the speed of {} ({} ms)", ms[0] / ms[best],
                                                     infoOf(techniques[0]).name, millisecondsText(ms[0]));
    return fmt::format("Take {} for this scene on this machine: {} ms a frame, {}, and {}.",
                       infoOf(techniques[best]).name, millisecondsText(ms[best]), pace,
                       agree ? "the same picture" : "beware: the pictures do not agree");
}

/// Commands that reproduce the page's figures. `source` is the scene argument; the scene's name may differ from it.
std::vector<std::string> commandsOf(const std::string& source, const frame::FrameSettings& settings) {
    const std::string frame =
        fmt::format("{} --size {}x{}", shellWord(source), settings.sizePixels.x, settings.sizePixels.y);
    if (settings.samples > 1) {
        return {fmt::format("tessera compare {} --samples {}", frame, settings.samples),
                fmt::format("tessera plan {} --technique forward --samples {}", frame, settings.samples)};
    }
    return {"tessera compare " + frame, "tessera compare " + frame + " --layout packed", "tessera plan " + frame};
}

/// Adds the benchmark's part of the page. Its images are smaller versions of the comparison's and are left out.
void addBench(validation::Report& report, const DemoResult& result) {
    const validation::BenchGroup* headline = validation::headlineGroup(*result.bench);
    report.bench = validation::benchHtml(*result.bench, *headline, {});
    report.facts.push_back(
        {"Measured at", fmt::format("{} \u00d7 {}", headline->sizePixels.x, headline->sizePixels.y)});
    report.facts.push_back({"Machine", result.bench->machine});
    report.commands.insert(report.commands.begin(), result.bench->command);
}

validation::Report makeReport(const std::string& source, const Request& request, const DemoResult& result) {
    const CompareResult& comparison = result.comparison;
    validation::Report report;
    report.title = fmt::format("{}, rendered {} ways", request.scene.name, result.techniques.size());
    report.record = comparison.record;
    report.choice = result.choice;
    report.facts = {{"Triangles", validation::countText(scenes::triangleCount(request.scene))},
                    {"Lights", fmt::format("{}", request.scene.lights.size())},
                    {"Materials", fmt::format("{}", request.scene.materials.size())}};
    if (comparison.record.samples > 1)
        report.facts.push_back({"Samples", fmt::format("{} a pixel", comparison.record.samples)});
    for (std::size_t i = 0; i < result.ms.size(); ++i)
        report.facts.push_back({std::string(infoOf(result.techniques[i]).name),
                                fmt::format("{} ms a frame", millisecondsText(result.ms[i]))});
    for (const Technique technique : result.techniques) {
        report.plans.push_back(
            {std::string(infoOf(technique).name),
             graph::planText(engine::planFrame(request.scene, technique,
                                               validation::supportedSettings(technique, request.settings)))});
    }
    const std::string& truth = comparison.truth.name;
    report.pictures.push_back({truth, "the truth of every pair", result.pictures[0]});
    for (std::size_t i = 0; i < comparison.pictures.size(); ++i) {
        const std::string& name = comparison.pictures[i].name;
        if (validation::showsNoError(comparison.record.pairs[i].figures)) continue; // identical to the truth
        report.pictures.push_back({name, "", result.pictures[i + 1]});
        report.heatMaps.push_back({name, truth, result.heatMaps[i]});
    }
    report.commands = commandsOf(source, request.settings);
    if (result.bench) addBench(report, result);
    return report;
}

/// Paths of the demo's outputs.
struct DemoFiles {
    fs::path folder;

    std::string page() const { return (folder / "index.html").string(); }
    std::string radiance(const Request& request) const {
        return (folder / pictureFile(request.scene.name, ".exr")).string();
    }
    std::string picture(const std::string& name) const { return (folder / pictureFile(name, ".png")).string(); }
};

validation::CompareRequest comparisonOf(const Request& request, const std::vector<Technique>& techniques) {
    validation::CompareRequest comparison;
    comparison.techniques.assign(techniques.begin() + 1, techniques.end());
    comparison.settings = request.settings;
    // Layouts need a G-buffer, which exists only with one sample per pixel.
    if (request.settings.samples == 1) comparison.layouts = {{kPacked, &frame::layoutTable()[1]}};
    comparison.channelShares = false; // the benchmark measures the causes of error
    return comparison;
}

Outputs outputsOf(const DemoFiles& files, const Request& request, const std::vector<Technique>& techniques) {
    Outputs outputs({files.page(), files.radiance(request)});
    outputs.add(files.picture(std::string(infoOf(techniques.front()).name)));
    for (const std::string& name : validation::pictureNames(request.scene, comparisonOf(request, techniques)))
        outputs.add(files.picture(name));
    if (request.settings.samples == 1) addBenchFiles(demoBenchFolder(files.folder.string()), outputs);
    outputs.reads(request.files);
    return outputs;
}

void encodePictures(DemoResult& result) {
    const validation::NamedPicture& truth = result.comparison.truth;
    std::vector<DisplayImage> shown = {truth.display}, heatMaps;
    for (const validation::NamedPicture& picture : result.comparison.pictures) {
        shown.push_back(picture.display);
        heatMaps.push_back(
            validation::errorHeatMap(picture.picture, truth.picture, picture.name + " vs " + truth.name));
    }
    result.pictures = encodePngs(shown);
    result.heatMaps = encodePngs(heatMaps);
}

void writePictures(const DemoFiles& files, const Outputs& outputs, const Request& request, const DemoResult& result) {
    makeFolder(files.folder.string());
    const validation::NamedPicture& truth = result.comparison.truth;
    writeExr(outputs.at(files.radiance(request)), truth.picture);
    const auto write = [&](const std::string& name, const Png& png) {
        writeFileAtomically(outputs.at(files.picture(name)), png.bytes);
    };
    write(truth.name, result.pictures[0]);
    for (std::size_t i = 0; i < result.comparison.pictures.size(); ++i)
        write(result.comparison.pictures[i].name, result.pictures[i + 1]);
}

int demo(const DemoOptions& options, const GlobalOptions& global) {
    requireFolderPlace(options.folder);
    Request request = resolve(options.frame);
    requireLitPicture(request.settings, "demo");
    const std::unique_ptr<gpu::Context> context = makeContext(global);
    request.settings = engine::settingsOn(context->capabilities(), request.settings);
    std::vector<validation::LeftOutTechnique> leftOut;
    DemoResult result;
    frame::FrameSettings sampled;
    sampled.samples = request.settings.samples;
    result.techniques = validation::techniquesSupporting(sampled, leftOut);
    if (leftOut.empty()) result.techniques.assign(std::begin(kShown), std::end(kShown));
    const DemoFiles files{options.folder};
    const Outputs outputs = outputsOf(files, request, result.techniques);
    {
        engine::Renderer renderer(*context, request.scene);
        filterEnvironment(request, renderer, global.quiet);
        validation::CompareRequest comparison = comparisonOf(request, result.techniques);
        Progress progress("rendering", validation::stepCount(request.scene, comparison), global.quiet);
        comparison.renderedOne = [&progress] { progress.advance(); };
        result.comparison = validation::compareTechniques(renderer, context->capabilities(), comparison);
        if (request.settings.samples > 1)
            result.ms = validation::frameMs(renderer, result.techniques, request.settings, kTimedFrames);
    }
    validation::CompareRecord& record = result.comparison.record;
    record.leftOut = std::move(leftOut);
    encodePictures(result);
    writePictures(files, outputs, request, result);
    if (request.settings.samples > 1) {
        result.choice = choiceOf(result.techniques, result.ms, record.ok());
    } else {
        result.bench =
            demoBench(*context, {options.frame, request, result.techniques, options.folder, outputs, global.quiet});
        result.choice = validation::recommendationText(*validation::headlineGroup(*result.bench));
    }
    outputs.write(files.page(), validation::reportHtml(makeReport(options.frame.scene, request, result)));
    fmt::print("{}\n{}\nreport    {}\npictures  {}\n", validation::compareTable(record), result.choice, files.page(),
               (fs::path(options.folder) / "*.png").string());
    return record.ok() ? kGood : kToleranceMissed;
}

} // namespace

void addDemoCommand(CLI::App& app, const GlobalOptions& global, Run& run) {
    CLI::App* command =
        app.add_subcommand("demo", "Renders a scene four ways, checks that they match, measures, writes a report");
    auto options = std::make_shared<DemoOptions>();
    addFrameOptions(*command, options->frame, "hall");
    command->remove_option(command->get_option("--technique")); // it shows several
    command
        ->add_option("-o,--output", options->folder,
                     "Where index.html, pictures, SCENE.exr and the folder bench go [out]")
        ->type_name("DIR");
    command->footer(R"(Examples
  tessera demo                          the scene hall; open out/index.html
  tessera demo model.glb -o report      a scene of one's own)");
    command->callback([options, &global, &run] { run = [options, &global] { return demo(*options, global); }; });
}

} // namespace tessera::app
