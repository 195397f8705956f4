#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "apps/Commands.h"
#include "apps/Comparison.h"
#include "apps/FilterEnvironment.h"
#include "apps/OutputFolder.h"
#include "apps/Outputs.h"
#include "apps/Progress.h"
#include "base/PictureFile.h"
#include "engine/Renderer.h"
#include "validation/compare/TechniqueCompare.h"
#include "validation/pictures/HeatMap.h"

namespace tessera::app {

namespace {

/// File suffixes of the relative-error map and the FLIP map.
constexpr const char* kMapExtensions[] = {".png", "_flip.png"};

struct CompareOptions : ComparisonOptions {
    std::string json, heatMaps;
};

std::string mapFile(const CompareOptions& options, const std::string& picture, const char* extension) {
    return (std::filesystem::path(options.heatMaps) / pictureFile(picture, extension)).string();
}

/// Registers the heat maps of each compared image.
void addHeatMaps(const CompareOptions& options, const std::vector<std::string>& pictures, Outputs& outputs) {
    for (const std::string& picture : pictures)
        for (const char* extension : kMapExtensions) outputs.add(mapFile(options, picture, extension));
}

void writeHeatMaps(const CompareOptions& options, const validation::CompareResult& result, const Outputs& outputs) {
    makeFolder(options.heatMaps);
    for (std::size_t i = 0; i < result.pictures.size(); ++i) {
        const validation::NamedPicture& picture = result.pictures[i];
        const validation::PairTruth& truth = result.truths[i];
        const std::string title = picture.name + " vs " + std::filesystem::path(result.truth.name).filename().string();
        writePng(outputs.at(mapFile(options, picture.name, kMapExtensions[0])),
                 validation::errorHeatMap(picture.picture, truth.picture, title, truth.excluded));
        if (picture.display.isConsistent() && result.truth.display.isConsistent()) {
            writePng(outputs.at(mapFile(options, picture.name, kMapExtensions[1])),
                     validation::flipHeatMap(picture.display, result.truth.display, "FLIP  " + title));
        }
    }
}

int compare(const CompareOptions& options, const GlobalOptions& global) {
    validation::Truth truth = truthOf(options);
    if (!options.json.empty()) requireOutput(options.json);
    if (!options.heatMaps.empty()) requireFolderPlace(options.heatMaps);
    const Request request = resolve(options.frame);
    Outputs outputs({options.json});
    outputs.reads(request.files);
    if (const auto* picture = std::get_if<validation::PictureTruth>(&truth)) outputs.reads({picture->path});
    Comparison comparison = comparisonOf(options, request, std::move(truth));
    if (!options.heatMaps.empty())
        addHeatMaps(options, validation::pictureNames(request.scene, comparison.request), outputs);
    warnOfComparison(options, request, comparison);
    const std::unique_ptr<gpu::Context> context = makeContext(global);
    warnOfDriver(context->capabilities(), request, comparison);
    engine::Renderer renderer(*context, request.scene);
    filterEnvironment(request, renderer, global.quiet);
    Progress progress("comparing", validation::stepCount(request.scene, comparison.request), global.quiet);
    comparison.request.renderedOne = [&progress] { progress.advance(); };
    const validation::CompareResult result = runComparison(renderer, context->capabilities(), comparison);
    progress.finish();
    if (!options.json.empty()) outputs.write(options.json, validation::compareJson(result.record));
    if (!options.heatMaps.empty()) writeHeatMaps(options, result, outputs);
    if (!isStandardOutput(options.json)) fmt::print("{}", validation::compareTable(result.record));
    return result.record.ok() ? kGood : kToleranceMissed;
}

} // namespace

void addCompareCommand(CLI::App& app, const GlobalOptions& global, Run& run) {
    CLI::App* command =
        app.add_subcommand("compare", "Renders a scene with several techniques and measures how they differ");
    auto options = std::make_shared<CompareOptions>();
    addFrameOptions(*command, options->frame, "");
    command->get_option("--technique")->description("Compares this technique alone, as --techniques does [all]");
    command->add_option("--techniques", options->techniques, "Techniques to compare [all]")->type_name("A,B");
    command->add_option("--against", options->against, "The truth: a technique, a picture file, or reference [forward]")
        ->type_name("NAME|FILE");
    command->add_option("--json", options->json, "Writes the figures as JSON; - prints them alone")->type_name("FILE");
    command->add_option("--heatmap", options->heatMaps, "Writes maps of the relative error and of FLIP of each pair")
        ->type_name("DIR");
    command->footer(R"(Examples
  tessera compare hall                                       every technique against forward
  tessera compare hall --layout packed --json packed.json    what a packed G-buffer costs
  tessera compare room --against room.exr --heatmap maps     against a picture; maps of the error
  tessera compare room --against reference                   against formulas in double precision

Exit code 3 says that a tolerance was missed.)");
    command->callback([options, &global, &run] { run = [options, &global] { return compare(*options, global); }; });
}

} // namespace tessera::app
