#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/Commands.h"
#include "apps/FilterEnvironment.h"
#include "apps/OutputFolder.h"
#include "apps/Outputs.h"
#include "apps/Progress.h"
#include "base/Error.h"
#include "base/Names.h"
#include "base/OneLine.h"
#include "base/PictureFile.h"
#include "engine/ChooseSamples.h"
#include "engine/PrepareView.h"
#include "engine/Renderer.h"
#include "renderer/frame/TextureRoom.h"
#include "validation/compare/ReferencePicture.h"
#include "validation/compare/TechniqueCompare.h"
#include "validation/pictures/HeatMap.h"
#include "validation/pictures/ReadPicture.h"

namespace tessera::app {

namespace {

/// Of the maps of the relative error and of FLIP.
constexpr const char* kMapExtensions[] = {".png", "_flip.png"};

struct CompareOptions {
    FrameOptions frame;
    std::string techniques;
    std::string against = "forward";
    std::string json, heatMaps;
};

std::vector<std::string> splitAtCommas(const std::string& text) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    while (begin <= text.size()) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

/// A technique's name, the reference, or the path of a picture that exists, which is not read yet.
validation::Truth truthNamed(const std::string& name) {
    if (name == kReferenceName) return validation::Reference{};
    std::vector<std::string_view> names{kReferenceName};
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) {
        if (info.name == name) return info.technique;
        names.push_back(info.name);
    }
    if (std::filesystem::exists(name)) return validation::PictureTruth{name, {}};
    throw InputError(fmt::format("--against '{}' is neither a technique nor a file that exists: {}", name,
                                 suggestNames(name, names)));
}

/// What the scene holds is in use already: one limit for all that a command reads.
Picture readBeside(const scenes::Scene& scene, const std::string& path, const FrameOptions& options) {
    scenes::LoadLedger ledger(loadOptionsOf(options).memoryLimitBytes);
    ledger.charge(scenes::bytesOf(scene), [&] { return options.scene; });
    return validation::readPicture(path, ledger);
}

/// Those asked for; else all but the truth that take the settings, the others to `leftOut`.
std::vector<engine::Technique> techniquesOf(const CompareOptions& options, const validation::Truth& against,
                                            const frame::FrameSettings& settings,
                                            std::vector<validation::LeftOutTechnique>& leftOut) {
    const auto* truth = std::get_if<engine::Technique>(&against);
    if (truth) engine::requireTaken({*truth, validation::settingsTakenBy(*truth, settings)});
    std::vector<engine::Technique> techniques;
    const std::string asked =
        options.techniques.empty() ? options.frame.said("technique").value_or("") : options.techniques;
    if (!asked.empty()) {
        for (const std::string& name : splitAtCommas(asked)) {
            const engine::Technique technique = techniqueNamed(name);
            if (std::find(techniques.begin(), techniques.end(), technique) != techniques.end())
                throw InputError(fmt::format("--techniques {} names {} twice", options.techniques, name));
            engine::requireTaken({technique, validation::settingsHeededBy(technique, settings)});
            techniques.push_back(technique);
        }
        return techniques;
    }
    techniques = validation::techniquesTaking(settings, leftOut);
    if (truth) std::erase(techniques, *truth);
    return techniques;
}

std::string mapFile(const CompareOptions& options, const std::string& picture, const char* extension) {
    return (std::filesystem::path(options.heatMaps) / pictureFile(picture, extension)).string();
}

/// Of each picture that will be compared.
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

void warnOfIntegers(const validation::Truth& truth) {
    const auto* picture = std::get_if<validation::PictureTruth>(&truth);
    if (picture == nullptr || !picture->picture.isInteger) return;
    spdlog::warn("{}", oneLine(picture->path + ": holds integers, which are cut off at white and rounded to steps, so "
                                               "tolerances for linear radiance do not apply to it; give an .exr"));
}

int compare(const CompareOptions& options, const GlobalOptions& global) {
    validation::CompareRequest comparison;
    comparison.against = truthNamed(options.against);
    if (options.frame.said("technique") && !options.techniques.empty())
        throw InputError("--technique and --techniques both say what to compare; give --techniques alone");
    if (!options.json.empty()) requireOutput(options.json);
    if (!options.heatMaps.empty()) requireFolderPlace(options.heatMaps);
    const Request request = resolve(options.frame);
    Outputs outputs({options.json});
    outputs.reads(request.files);
    if (auto* picture = std::get_if<validation::PictureTruth>(&comparison.against)) {
        outputs.reads({picture->path});
        picture->picture = readBeside(request.scene, picture->path, options.frame);
    }
    comparison.settings = request.settings;
    if (const frame::DebugViewInfo& view = frame::debugViewInfo(request.settings.view); view.ofTechnique)
        throw InputError(fmt::format(
            "--view {} shows what each technique does, which is not meant to be the same; render it", view.name));
    std::vector<validation::LeftOutTechnique> leftOut;
    comparison.techniques = techniquesOf(options, comparison.against, request.settings, leftOut);
    if (std::holds_alternative<validation::Reference>(comparison.against)) {
        validation::requireReferenceTakes(comparison.settings);
        // Hardware filtering would hide the compared differences; it gets a pair of its own.
        if (!options.frame.said("filter")) comparison.settings.filter = frame::TextureFilter::Exact;
        // The reference shows the map as it is; a blurred one is a matter of taste, not of light.
        if (comparison.settings.environment.backdrop == frame::Backdrop::Blurred)
            comparison.settings.environment.backdrop = frame::Backdrop::Sharp;
    }
    if (!options.heatMaps.empty()) addHeatMaps(options, validation::pictureNames(request.scene, comparison), outputs);
    const frame::PreparedView prepared =
        engine::prepareView(request.scene, engine::Technique::Forward,
                            validation::settingsHeededBy(engine::Technique::Forward, comparison.settings));
    for (const std::string& unheeded : unheededShadows(options.frame, request, prepared)) spdlog::warn("{}", unheeded);
    if (const std::string missing =
            engine::missingShadows(request.scene, frame::surfaceBounds(request.scene), prepared);
        !missing.empty())
        spdlog::warn("{}", oneLine(request.scene.name + ": " + missing));
    if (const std::string unseen = engine::unseenSpread(request.scene, prepared); !unseen.empty())
        spdlog::warn("{}", oneLine(request.scene.name + ": " + unseen));
    const std::unique_ptr<gpu::Context> context = makeContext(global);
    const frame::FrameSettings onDriver = engine::settingsOn(context->capabilities(), prepared.spec.settings);
    if (const std::string missing =
            frame::missingTextures(engine::prepareView(request.scene, engine::Technique::Forward, onDriver).spec);
        !missing.empty())
        spdlog::warn("{}", oneLine(request.scene.name + ": " + missing));
    engine::Renderer renderer(*context, request.scene);
    filterEnvironment(request, renderer, global.quiet);
    Progress progress("comparing", validation::stepCount(request.scene, comparison), global.quiet);
    comparison.renderedOne = [&progress] { progress.advance(); };
    validation::CompareResult result = validation::compareTechniques(renderer, context->capabilities(), comparison);
    result.record.leftOut = std::move(leftOut);
    progress.finish();
    warnOfIntegers(comparison.against);
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
