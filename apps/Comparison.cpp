#include "apps/Comparison.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "base/Error.h"
#include "base/Names.h"
#include "base/OneLine.h"
#include "engine/ChooseSamples.h"
#include "engine/PrepareView.h"
#include "renderer/frame/TextureRoom.h"
#include "scenes/LoadLedger.h"
#include "validation/compare/ReferencePicture.h"
#include "validation/pictures/ReadPicture.h"

namespace tessera::app {

namespace {

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

/// Parses a truth: a technique's name, the reference, or the path of an existing image, which is not read yet.
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

/// Reads an image. The scene counts against the same memory limit.
Picture readBeside(const scenes::Scene& scene, const std::string& path, const FrameOptions& options) {
    const scenes::LoadOptions load = loadOptionsOf(options);
    scenes::LoadLedger ledger(load.memoryLimitBytes, load.import);
    ledger.charge(scenes::bytesOf(scene), [&] { return options.scene; });
    Picture picture = validation::readPicture(path, ledger);
    for (const std::string& warning : ledger.takeWarnings()) spdlog::warn("{}", oneLine(warning));
    return picture;
}

/// The requested techniques; by default all that support the settings, except the truth. Sets `leftOut` to the rest.
std::vector<engine::Technique> techniquesOf(const ComparisonOptions& options, const validation::Truth& against,
                                            const frame::FrameSettings& settings,
                                            std::vector<validation::LeftOutTechnique>& leftOut) {
    const auto* truth = std::get_if<engine::Technique>(&against);
    if (truth) engine::requireSupported({*truth, validation::supportedSettings(*truth, settings)});
    std::vector<engine::Technique> techniques;
    const std::string requested =
        options.techniques.empty() ? options.frame.said("technique").value_or("") : options.techniques;
    if (!requested.empty()) {
        for (const std::string& name : splitAtCommas(requested)) {
            const engine::Technique technique = techniqueNamed(name);
            if (std::find(techniques.begin(), techniques.end(), technique) != techniques.end())
                throw InputError(fmt::format("--techniques {} names {} twice", options.techniques, name));
            engine::requireSupported({technique, validation::settingsUsedBy(technique, settings)});
            techniques.push_back(technique);
        }
        return techniques;
    }
    techniques = validation::techniquesSupporting(settings, leftOut);
    if (truth) std::erase(techniques, *truth);
    return techniques;
}

frame::PreparedView preparedForward(const Request& request, const Comparison& comparison) {
    return engine::prepareView(request.scene, engine::Technique::Forward,
                               validation::settingsUsedBy(engine::Technique::Forward, comparison.request.settings));
}

void warnOfIntegers(const validation::Truth& truth) {
    const auto* picture = std::get_if<validation::PictureTruth>(&truth);
    if (picture == nullptr || !picture->picture.isInteger) return;
    spdlog::warn("{}", oneLine(picture->path + ": holds integers, which are cut off at white and rounded to steps, so "
                                               "tolerances for linear radiance do not apply to it; give an .exr"));
}

} // namespace

validation::Truth truthOf(const ComparisonOptions& options) {
    validation::Truth truth = truthNamed(options.against);
    if (options.frame.said("technique") && !options.techniques.empty())
        throw InputError("--technique and --techniques both say what to compare; give --techniques alone");
    return truth;
}

Comparison comparisonOf(const ComparisonOptions& options, const Request& request, validation::Truth truth) {
    Comparison comparison;
    validation::CompareRequest& compare = comparison.request;
    compare.against = std::move(truth);
    if (auto* picture = std::get_if<validation::PictureTruth>(&compare.against))
        picture->picture = readBeside(request.scene, picture->path, options.frame);
    compare.settings = request.settings;
    if (const frame::DebugViewInfo& view = frame::debugViewInfo(request.settings.view); view.ofTechnique)
        throw InputError(fmt::format(
            "--view {} shows what each technique does, which is not meant to be the same; render it", view.name));
    compare.techniques = techniquesOf(options, compare.against, request.settings, comparison.leftOut);
    if (std::holds_alternative<validation::Reference>(compare.against)) {
        validation::requireReferenceSupports(compare.settings);
        // Hardware filtering would hide the compared differences; it is compared in a separate pair.
        if (!options.frame.said("filter")) compare.settings.filter = frame::TextureFilter::Exact;
        // The reference shows the unblurred map; the blur is an aesthetic choice, not a lighting difference.
        if (compare.settings.environment.backdrop == frame::Backdrop::Blurred)
            compare.settings.environment.backdrop = frame::Backdrop::Sharp;
    }
    return comparison;
}

void warnOfComparison(const ComparisonOptions& options, const Request& request, const Comparison& comparison) {
    const frame::PreparedView prepared = preparedForward(request, comparison);
    std::vector<engine::Technique> techniques = comparison.request.techniques;
    if (const auto* truth = std::get_if<engine::Technique>(&comparison.request.against)) techniques.push_back(*truth);
    const bool besideReference = std::holds_alternative<validation::Reference>(comparison.request.against);
    for (const std::string& unused : unusedSettings(options.frame, request, prepared, techniques, besideReference))
        spdlog::warn("{}", unused);
    if (const std::string missing =
            engine::missingShadows(request.scene, frame::surfaceBounds(request.scene), prepared);
        !missing.empty())
        spdlog::warn("{}", oneLine(request.scene.name + ": " + missing));
    if (const std::string unseen = engine::invisibleDiffusion(request.scene, prepared); !unseen.empty())
        spdlog::warn("{}", oneLine(request.scene.name + ": " + unseen));
    warnOfIntegers(comparison.request.against);
}

void warnOfDriver(const gpu::Capabilities& gl, const Request& request, const Comparison& comparison) {
    const frame::FrameSettings onDriver = engine::settingsOn(gl, preparedForward(request, comparison).spec.settings);
    if (const std::string missing =
            frame::missingTextures(engine::prepareView(request.scene, engine::Technique::Forward, onDriver).spec);
        !missing.empty())
        spdlog::warn("{}", oneLine(request.scene.name + ": " + missing));
}

validation::CompareResult runComparison(engine::Renderer& renderer, const gpu::Capabilities& gl,
                                        const Comparison& comparison) {
    validation::CompareResult result = validation::compareTechniques(renderer, gl, comparison.request);
    result.record.leftOut = comparison.leftOut;
    return result;
}

} // namespace tessera::app
