#include "validation/compare/TechniqueCompare.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "engine/ChooseSamples.h"
#include "engine/Rendering.h"
#include "engine/Settings.h"
#include "renderer/frame/MaterialFeatures.h"
#include "validation/compare/LongestSpan.h"
#include "validation/compare/RangeTruncation.h"
#include "validation/compare/ReferencePicture.h"
#include "validation/compare/ShownTriangles.h"

namespace tessera::validation {

namespace {

using engine::Technique;

/// An image to compare with the truth.
struct RequestedPicture {
    Technique technique;
    std::string name;
    frame::FrameSettings settings; ///< the request's, except for the layout
};

std::vector<RequestedPicture> requestedPictures(const CompareRequest& request) {
    std::vector<RequestedPicture> all;
    for (const Technique technique : request.techniques)
        all.push_back({technique, std::string(infoOf(technique).name), request.settings});
    for (const LayoutPair& pair : request.layouts) {
        all.push_back(
            {pair.technique, fmt::format("{} ({})", infoOf(pair.technique).name, pair.layout->name), request.settings});
        all.back().settings.layout = pair.layout->layout;
    }
    return all;
}

NamedPicture rendered(engine::Renderer& renderer, Technique technique, const frame::FrameSettings& settings) {
    const engine::RenderedFrame frame = renderer.render(technique, supportedSettings(technique, settings));
    return {std::string(infoOf(technique).name), toPicture(frame), toDisplayImage(frame)};
}

bool isReference(const CompareRequest& request) {
    return std::holds_alternative<Reference>(request.against);
}

/// The truth that images are measured against.
struct TruthPicture {
    NamedPicture own;
    std::optional<ReferencePicture> reference;
    ShownTriangles triangles; ///< where the reference shows other surfaces than the GPU

    PairTruth of(const Picture& shown) const {
        return {reference ? reference->nearestTo(shown) : own.picture, triangles.excluded};
    }
    RadianceFigures figuresOf(const Picture& shown) const {
        const PairTruth truth = of(shown);
        return radianceFigures(shown, truth.picture, truth.excluded);
    }
    /// Against the reference, errors are multiplied by its errorWeights.
    Verdict verdictOf(const Picture& shown, const Tolerance& tolerance) const {
        PairTruth truth = of(shown);
        if (reference) truth.picture = reference->weighted(std::move(truth.picture), shown);
        return checkTolerance(radianceFigures(shown, truth.picture, truth.excluded), tolerance);
    }
};

TruthPicture referenceTruth(engine::Renderer& renderer, const frame::FrameSettings& settings,
                            const std::function<void()>& rowDone) {
    TruthPicture truth;
    truth.reference = referencePicture(renderer, settings, rowDone);
    truth.triangles = shownTriangles(renderer, settings, truth.reference->ids);
    truth.own = {"reference", truth.reference->picture, engine::toDisplayImage(truth.reference->picture, settings)};
    return truth;
}

TruthPicture truthPicture(engine::Renderer& renderer, const CompareRequest& request) {
    if (isReference(request)) return referenceTruth(renderer, request.settings, request.renderedOne);
    if (const auto* technique = std::get_if<Technique>(&request.against)) {
        TruthPicture truth{rendered(renderer, *technique, request.settings), {}, {}};
        request.renderedOne();
        return truth;
    }
    const auto& [path, picture] = std::get<PictureTruth>(request.against);
    TruthPicture truth{{path, picture, {}}, {}, {}};
    truth.own.display = toDisplayImage(truth.own.picture);
    return truth;
}

bool measuresTruncation(const CompareRequest& request) {
    return request.settings.rangeTolerance > 0.0 &&
           (std::holds_alternative<Technique>(request.against) || !request.techniques.empty());
}

RangeTruncation truncationOf(engine::Renderer& renderer, const CompareRequest& request) {
    const auto* truth = std::get_if<Technique>(&request.against);
    const Technique technique = truth ? *truth : request.techniques.front();
    return rangeTruncation(renderer, technique, supportedSettings(technique, request.settings));
}

/// The culling method of the frame just drawn; empty if it visits all lights.
std::string cullingText(const engine::Renderer& renderer) {
    const culling::Choice choice = renderer.downloadLists().culling;
    if (choice.method == culling::Method::None) return {};
    return fmt::format("{}, tile {}, lists built by {}", infoOf(choice.method).name, choice.tilePixels,
                       infoOf(choice.builder).name);
}

bool isPacked(const frame::GBufferLayout& layout) {
    return !(layout == frame::exactLayout().layout);
}

/// The packing of a technique's image; exact without a G-buffer.
const frame::GBufferLayout& packingOf(Technique technique, const frame::GBufferLayout& layout) {
    return infoOf(technique).usesGBuffer() ? layout : frame::exactLayout().layout;
}

/// The same for the truth.
const frame::GBufferLayout& packingOfTruth(const CompareRequest& request) {
    const auto* const truth = std::get_if<Technique>(&request.against);
    return truth ? packingOf(*truth, request.settings.layout) : frame::exactLayout().layout;
}

/// The packing that separates an image from the truth: the coarser of both, or exact if both are packed alike.
const frame::GBufferLayout& packingApart(const CompareRequest& request, Technique technique,
                                         const frame::GBufferLayout& layout) {
    const frame::GBufferLayout &own = packingOf(technique, layout), &truth = packingOfTruth(request);
    if (own == truth) return frame::exactLayout().layout;
    return frame::promiseOf(own).relMse < frame::promiseOf(truth).relMse ? truth : own;
}

/// The index of an earlier G-buffer image with the same layout that is bit-identical to `picture`.
std::optional<std::size_t> equalPicture(const CompareResult& result, std::span<const RequestedPicture> requested,
                                        const RequestedPicture& one, const Picture& picture) {
    for (std::size_t i = 0; i < result.pictures.size(); ++i)
        if (infoOf(requested[i].technique).usesGBuffer() && requested[i].settings.layout == one.settings.layout &&
            result.pictures[i].picture.rgba == picture.rgba)
            return i;
    return {};
}

/// Groups the stored channels that are put into fp32 together. Microsurface holds one alpha and tangent the other: both
/// are equal on an isotropic surface, and rounding only one would make it anisotropic.
std::vector<std::vector<frame::Channel>> channelsOfOneError(const frame::FeatureSet& features,
                                                            const frame::GBufferLayout& layout) {
    using frame::Channel;
    std::vector<std::vector<Channel>> groups;
    for (const Channel channel : frame::neededChannels(features, layout, false)) {
        const auto alphas = std::ranges::find(groups, std::vector{Channel::Microsurface});
        if (channel == Channel::Tangent && alphas != groups.end())
            alphas->push_back(channel);
        else
            groups.push_back({channel});
    }
    return groups;
}

/// The error that each stored channel causes, from the pair's relMse with that channel alone in fp32.
std::vector<ChannelShare> channelShares(engine::Renderer& renderer, const RequestedPicture& requested,
                                        const TruthPicture& truth, double relMse) {
    std::vector<ChannelShare> shares;
    const frame::FeatureSet features =
        frame::surfaceFeatures(renderer.scene(), requested.settings.prune, requested.settings.subsurface);
    for (const std::vector<frame::Channel>& channels : channelsOfOneError(features, requested.settings.layout)) {
        frame::FrameSettings settings = requested.settings;
        std::vector<std::string_view> names;
        for (const frame::Channel channel : channels) {
            settings.layout.encoding[std::size_t(channel)] = frame::Encoding::Exact;
            names.push_back(frame::channelTable()[std::size_t(channel)].name);
        }
        const Picture picture =
            toPicture(renderer.render(requested.technique, supportedSettings(requested.technique, settings)));
        const double without = truth.figuresOf(picture).relMse;
        shares.push_back({fmt::format("{}", fmt::join(names, " and ")), without, relMse - without});
    }
    return shares;
}

/// The tolerance of a technique with a layout against the requested truth.
Tolerance toleranceOf(const engine::Renderer& renderer, const gpu::Capabilities& gl, const CompareRequest& request,
                      Technique technique, const frame::GBufferLayout& layout) {
    const frame::GBufferLayout& packing = packingApart(request, technique, layout);
    if (isReference(request) && !isPacked(packing)) return referenceTolerance(renderer.scene(), request.settings);
    const std::vector<scenes::Light>& lights = renderer.scene().lights;
    const auto on =
        std::count_if(lights.begin(), lights.end(), [](const scenes::Light& light) { return light.enabled; });
    return pairTolerance(technique, packing, gl.isSoftware, std::size_t(on));
}

bool showsSigned(const CompareRequest& request) {
    return frame::displayMapping(request.settings.view, request.settings.layout) == frame::DisplayMapping::Signed;
}

/// Checks the image with every channel in fp32 against the exact layout's tolerance. A packed layout's tolerance alone
/// could hide a faint light that was skipped; with this check only quantisation is left to differ.
void checkWithoutPacking(engine::Renderer& renderer, const gpu::Capabilities& gl, const CompareRequest& request,
                         const RequestedPicture& requested, const TruthPicture& truth, Verdict& verdict) {
    frame::FrameSettings settings = requested.settings;
    settings.layout = frame::exactLayout().layout;
    const Picture picture =
        toPicture(renderer.render(requested.technique, supportedSettings(requested.technique, settings)));
    Tolerance tolerance = toleranceOf(renderer, gl, request, requested.technique, settings.layout);
    tolerance.isSigned = showsSigned(request);
    for (const std::string& missed : truth.verdictOf(picture, tolerance).missed)
        verdict.missed.push_back("with every channel in fp32: " + missed);
    verdict.ok = verdict.missed.empty();
}

/// Both images with the exposure and tone map of the settings. Those of a file are unknown, so then both go without.
ShownPair shownPair(const CompareRequest& request, const DisplayImage& a, const DisplayImage& truth) {
    const bool haveDisplay = !std::holds_alternative<PictureTruth>(request.against) && request.settings.display;
    return haveDisplay ? ShownPair{&a, &truth} : ShownPair{};
}

/// Whether to add a pair with hardware filtering; all other pairs filter exactly.
bool showsHardwareFilter(const scenes::Scene& scene, const CompareRequest& request) {
    return isReference(request) && request.hardwareFilter && !request.techniques.empty() &&
           request.settings.filter == frame::TextureFilter::Exact && frame::materialFeatures(scene).textures();
}

void addHardwareFilter(engine::Renderer& renderer, const CompareRequest& request, CompareResult& result) {
    frame::FrameSettings settings = request.settings;
    settings.filter = frame::TextureFilter::Hardware;
    settings.layout = frame::exactLayout().layout;
    NamedPicture picture = rendered(renderer, request.techniques.front(), settings);
    picture.name = hardwareFilterName(picture.name);
    const TruthPicture reference = referenceTruth(renderer, settings, request.renderedOne);
    PairTruth truth = reference.of(picture.picture);
    result.record.pairs.push_back(comparePair(
        picture.name, picture.picture, result.truth.name, truth.picture, referenceTolerance(renderer.scene(), settings),
        truth.excluded, shownPair(request, picture.display, engine::toDisplayImage(truth.picture, settings))));
    ComparePair& pair = result.record.pairs.back();
    pair.verdict = reference.verdictOf(picture.picture, pair.tolerance);
    missLostGeometry(pair.verdict, reference.triangles.lost);
    result.record.excludesPixels |= !reference.triangles.excluded.empty();
    std::vector<LostGeometry>& all = result.record.lost;
    for (const LostGeometry& lost : reference.triangles.lost)
        if (std::ranges::none_of(all, [&](const LostGeometry& known) { return known.isOfSame(lost); }))
            all.push_back(lost);
    result.pictures.push_back(std::move(picture));
    result.truths.push_back(std::move(truth));
}

template <typename Drops>
frame::FrameSettings resetWhere(Technique technique, const frame::FrameSettings& settings, const Drops& drops) {
    engine::ViewRequest request{technique, settings};
    for (const engine::Setting& setting : engine::settingTable())
        if (drops(setting, request)) setting.reset(request);
    return request.settings;
}

} // namespace

frame::FrameSettings supportedSettings(engine::Technique technique, const frame::FrameSettings& settings) {
    return resetWhere(technique, settings, [](const engine::Setting& setting, const engine::ViewRequest& request) {
        return setting.samePicture && !setting.isSupported(request);
    });
}

frame::FrameSettings settingsUsedBy(engine::Technique technique, const frame::FrameSettings& settings) {
    return resetWhere(technique, settings, [](const engine::Setting& setting, const engine::ViewRequest& request) {
        return setting.samePicture && !setting.isUsedBy(request.technique);
    });
}

std::string hardwareFilterName(const std::string& technique) {
    return technique + " (hardware filter)";
}

std::size_t stepCount(const scenes::Scene& scene, const CompareRequest& request) {
    const std::size_t references = showsHardwareFilter(scene, request) ? 2 : 1;
    const std::size_t truth = isReference(request) ? references * std::size_t(request.settings.sizePixels.y)
                              : std::holds_alternative<Technique>(request.against) ? 1
                                                                                   : 0;
    return requestedPictures(request).size() + truth + (measuresTruncation(request) ? 1 : 0);
}

std::vector<std::string> pictureNames(const scenes::Scene& scene, const CompareRequest& request) {
    std::vector<std::string> names;
    for (RequestedPicture& requested : requestedPictures(request)) names.push_back(std::move(requested.name));
    if (showsHardwareFilter(scene, request)) names.push_back(hardwareFilterName(names.front()));
    return names;
}

std::vector<Technique> techniquesSupporting(const frame::FrameSettings& settings,
                                            std::vector<LeftOutTechnique>& leftOut) {
    std::vector<Technique> techniques;
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) {
        const engine::ViewRequest request{info.technique, settingsUsedBy(info.technique, settings)};
        const auto table = engine::settingTable();
        const auto refused =
            std::ranges::find_if(table, [&](const engine::Setting& setting) { return !setting.isSupported(request); });
        if (refused == table.end())
            techniques.push_back(info.technique);
        else
            leftOut.push_back({std::string(info.name),
                               fmt::format("it does not support {} {}", refused->name, refused->text(request))});
    }
    return techniques;
}

Tolerance pairTolerance(Technique technique, const frame::GBufferLayout& packing, bool isSoftware,
                        std::size_t lightCount) {
    Tolerance tolerance;
    if (isPacked(packing)) {
        const frame::LayoutPromise& promise = frame::promiseOf(packing);
        tolerance.relMse = promise.relMse;
        tolerance.p999Rel = promise.p999Rel;
        tolerance.bias = promise.bias;
        tolerance.biasNoises = kBiasNoises;
        tolerance.reason =
            fmt::format("the layout's promise: rms error at most {:.1f} %, 99.9 % of the pixels within about a step of "
                        "k_s, and dithering keeps the mean",
                        100.0 * std::sqrt(promise.relMse));
    } else if (isSoftware) {
        tolerance.bitEqual = 1.0;
        tolerance.maxRel = 0.0;
        tolerance.reason =
            "one lighting source, fp32 throughout and no contraction: software rasterisers agree to the last bit";
    } else {
        tolerance.maxRel = 1e-5;
        tolerance.reason = "a hardware compiler may contract two programs differently: some 100 roundings of 2^-24";
        const double sumBound = double(lightCount) * 0x1p-24;
        if (infoOf(technique).addsByBlending && sumBound > tolerance.maxRel) {
            tolerance.maxRel = sumBound;
            tolerance.reason = "lights are summed by blending: N positive terms in fp32 differ by up to N 2^-24";
        }
    }
    return tolerance;
}

/// Means over the pixels with diffused light; unset if there are none.
std::optional<DiffusedLight> diffusedLight(const ReferencePicture& truth) {
    DiffusedLight sum{0, 0.0, 0.0};
    for (const reference::Diffusion::Answer& answer : truth.diffused) {
        if (answer.whole == glm::dvec3(0.0)) continue;
        ++sum.pixels;
        sum.integral += (answer.whole.r + answer.whole.g + answer.whole.b) / 3.0;
        sum.facingAway += answer.apart;
    }
    if (sum.pixels == 0) return {};
    return DiffusedLight{sum.pixels, sum.integral / double(sum.pixels), sum.facingAway / double(sum.pixels)};
}

CompareResult compareTechniques(engine::Renderer& renderer, const gpu::Capabilities& gl,
                                const CompareRequest& request) {
    CompareResult result;
    const TruthPicture truth = truthPicture(renderer, request);
    result.truth = truth.own;
    result.record.lost = truth.triangles.lost;
    if (truth.reference) result.record.diffusedLight = diffusedLight(*truth.reference);
    result.record.excludesPixels = !truth.triangles.excluded.empty();
    result.record.scene = renderer.scene().name;
    result.record.width = request.settings.sizePixels.x;
    result.record.height = request.settings.sizePixels.y;
    result.record.samples = engine::chooseSamples(engine::settingsOn(gl, request.settings));
    result.record.renderer = gl.renderer;
    const std::vector<RequestedPicture> all = requestedPictures(request);
    for (const RequestedPicture& requested : all) {
        NamedPicture picture = rendered(renderer, requested.technique, requested.settings);
        picture.name = requested.name;
        const std::string culling = cullingText(renderer);
        requireSameSize(picture.picture, picture.name, result.truth.picture, result.truth.name);
        Tolerance tolerance = request.tolerance
                                  ? *request.tolerance
                                  : toleranceOf(renderer, gl, request, requested.technique, requested.settings.layout);
        tolerance.isSigned = showsSigned(request);
        PairTruth own = truth.of(picture.picture);
        const DisplayImage nearest =
            truth.reference ? engine::toDisplayImage(own.picture, requested.settings) : truth.own.display;
        ComparePair pair = comparePair(picture.name, picture.picture, truth.own.name, own.picture, tolerance,
                                       own.excluded, shownPair(request, picture.display, nearest));
        pair.culling = culling;
        if (truth.reference && !request.tolerance &&
            !isPacked(packingOf(requested.technique, requested.settings.layout)))
            pair.verdict = truth.verdictOf(picture.picture, tolerance);
        if (truth.reference && hasTracedShadows(renderer.scene(), requested.settings) &&
            !isPacked(packingOf(requested.technique, requested.settings.layout))) {
            pair.shadows = truth.reference->shadowFigures(picture.picture, own.excluded);
            // The noise contains every other error, such as that of area lights, so it is judged only if they are.
            if (!tolerance.relMse) pair.shadows->mostNoise.reset();
            if (!request.tolerance)
                for (std::string& missed : missedByShadows(*pair.shadows, longestSpan(renderer.scene())))
                    pair.verdict.missed.push_back(std::move(missed));
            pair.verdict.ok = pair.verdict.missed.empty();
        }
        // Against a truth that is packed too, fp32 would only measure the truth's packing.
        if (isPacked(packingOf(requested.technique, requested.settings.layout)) && !isPacked(packingOfTruth(request))) {
            if (request.channelShares) {
                // Identical images from one G-buffer have the same error per channel.
                const std::optional<std::size_t> equal = equalPicture(result, all, requested, picture.picture);
                pair.channels = equal ? result.record.pairs[*equal].channels
                                      : channelShares(renderer, requested, truth, pair.figures.relMse);
            }
            // An image file need not come from this renderer, so the exact layout's tolerance does not apply to it.
            if (!request.tolerance && !std::holds_alternative<PictureTruth>(request.against))
                checkWithoutPacking(renderer, gl, request, requested, truth, pair.verdict);
        }
        result.record.pairs.push_back(std::move(pair));
        result.pictures.push_back(std::move(picture));
        result.truths.push_back(std::move(own));
        request.renderedOne();
    }
    for (ComparePair& pair : result.record.pairs) missLostGeometry(pair.verdict, result.record.lost);
    if (showsHardwareFilter(renderer.scene(), request)) addHardwareFilter(renderer, request, result);
    if (measuresTruncation(request)) {
        result.record.rangeTruncation = truncationOf(renderer, request);
        request.renderedOne();
    }
    return result;
}

} // namespace tessera::validation
