#include "validation/bench/Attribution.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "engine/PrepareView.h"
#include "renderer/frame/MaterialFeatures.h"
#include "validation/compare/RangeTruncation.h"
#include "validation/compare/TechniqueCompare.h"
#include "validation/figures/ErrorFigures.h"

namespace tessera::validation {

namespace {

using engine::Technique;

std::optional<double> finite(double value) {
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

AttributionLine lineOf(const char* cause, const std::string& what, const std::string& against,
                       const RadianceFigures& figures) {
    return {cause, what, against, finite(figures.relMse), finite(figures.p99Rel), finite(figures.bias)};
}

void addFilter(const GroupTruth& truth, const std::string& truthName, const Picture& exact, const BenchPoint& any,
               std::vector<AttributionLine>& lines) {
    const bool isSoft =
        any.key.shadow && engine::prepareView(truth.renderer().scene(), Technique::Forward, truth.settings())
                              .lights.features[frame::Feature::SoftShadows];
    const std::string noise =
        isSoft ? fmt::format(" and the noise of {} rays", truth.settings().shadowSamples) : std::string();
    lines.push_back(lineOf("arithmetic", "fp32 arithmetic of forward" + noise, truthName,
                           radianceFigures(exact, truth.pictureFor(exact), truth.excluded())));
    // Nothing was chosen where the timed frames filter exactly too.
    if (any.settings.filter == frame::TextureFilter::Exact || truth.filter() != frame::TextureFilter::Exact ||
        !frame::materialFeatures(truth.renderer().scene()).textures())
        return;
    frame::FrameSettings hardware = truth.settings();
    hardware.filter = frame::TextureFilter::Hardware;
    const engine::RenderedFrame frame = truth.renderer().render(Technique::Forward, hardware);
    Picture filtered = exact; // the same pixels are covered
    filtered.rgba = frame.radiance;
    lines.push_back(lineOf(kFilterCause, "smaller texture levels, hardware filter", "level 0 alone, exact filter",
                           radianceFigures(filtered, exact)));
}

/// What goes away where shadows are traced, with rays enough.
void addShadows(const GroupTruth& truth, const Picture& exact, std::span<const BenchPoint> points,
                std::vector<AttributionLine>& lines) {
    std::set<std::string> done;
    for (const BenchPoint& point : points) {
        if (!point.key.shadow || !done.insert(shadowText(*point.key.shadow)).second) continue;
        frame::FrameSettings settings = truth.settings();
        settings.shadows = point.settings.shadows;
        settings.shadowFilter = point.settings.shadowFilter;
        settings.shadowSamples = point.settings.shadowSamples;
        settings.shadowMaps = point.settings.shadowMaps;
        const bool isExact =
            point.key.shadow->filter != kNoShadows && !point.key.shadow->usesMaps() && point.key.shadow->values.empty();
        if (isExact) continue;
        const std::string text = shadowText(*point.key.shadow);
        const Picture shown = truth.pictureOf(Technique::Forward, settings);
        lines.push_back(lineOf("shadow", point.key.shadow->filter == kNoShadows ? text : "shadow filter " + text,
                               "traced", radianceFigures(shown, exact, truth.excluded())));
    }
}

/// What goes away where a part of the light is found as the reference finds it: the difference from the truth beside
/// that of rounding, so it is known against the reference alone. `textOf` names how a point finds it, empty where it
/// has none; `take` takes that from its settings.
template <typename TextOf, typename Take>
void addFoundLight(const char* cause, const GroupTruth& truth, const std::string& truthName,
                   std::span<const BenchPoint> points, std::vector<AttributionLine>& lines, const TextOf& textOf,
                   const Take& take) {
    std::set<std::string> done;
    for (const BenchPoint& point : points) {
        const std::string text = textOf(point.key);
        if (text.empty() || !done.insert(text).second) continue;
        frame::FrameSettings settings = truth.settings();
        take(settings, point.settings);
        const Picture shown = truth.pictureOf(Technique::Forward, settings);
        lines.push_back(
            lineOf(cause, text, truthName, radianceFigures(shown, truth.pictureFor(shown), truth.excluded())));
    }
}

/// Light that spreads over surfaces.
void addSubsurfaces(const GroupTruth& truth, const std::string& truthName, std::span<const BenchPoint> points,
                    std::vector<AttributionLine>& lines) {
    addFoundLight(
        "subsurface", truth, truthName, points, lines,
        [](const PointKey& key) { return key.subsurface ? subsurfaceText(*key.subsurface) : std::string(); },
        [](frame::FrameSettings& settings, const frame::FrameSettings& own) {
            settings.subsurface = own.subsurface;
            settings.diffusion = own.diffusion;
        });
}

/// Light of the environment.
void addEnvironments(const GroupTruth& truth, const std::string& truthName, std::span<const BenchPoint> points,
                     std::vector<AttributionLine>& lines) {
    addFoundLight(
        "environment", truth, truthName, points, lines,
        [](const PointKey& key) { return key.environment ? environmentText(*key.environment) : std::string(); },
        [](frame::FrameSettings& settings, const frame::FrameSettings& own) {
            settings.environment = own.environment;
        });
}

/// Light of area lights.
void addAreas(const GroupTruth& truth, const std::string& truthName, std::span<const BenchPoint> points,
              std::vector<AttributionLine>& lines) {
    addFoundLight(
        "area", truth, truthName, points, lines,
        [](const PointKey& key) { return key.area ? areaText(*key.area) : std::string(); },
        [](frame::FrameSettings& settings, const frame::FrameSettings& own) { settings.area = own.area; });
}

void addRanges(const GroupTruth& truth, std::span<const BenchPoint> points, std::vector<AttributionLine>& lines) {
    std::set<double> tolerances;
    for (const BenchPoint& point : points) tolerances.insert(point.settings.rangeTolerance);
    for (const double tolerance : tolerances) {
        if (tolerance == 0.0) continue;
        frame::FrameSettings settings = truth.settings();
        settings.rangeTolerance = tolerance;
        const RangeTruncation dropped = rangeTruncation(truth.renderer(), Technique::Forward, settings);
        lines.push_back(
            lineOf("range", fmt::format("range tolerance {:g}", tolerance), "no tolerance", dropped.figures));
    }
}

/// The error of each channel of a layout is that of `tessera compare`.
void addLayouts(const gpu::Capabilities& gl, const GroupTruth& truth, std::span<const BenchPoint> points,
                std::vector<AttributionLine>& lines) {
    std::set<std::string> done;
    for (const BenchPoint& point : points) {
        const bool isPacked = !(point.settings.layout == frame::exactLayout().layout);
        if (!isPacked || !done.insert(point.key.layout).second) continue;
        CompareRequest request;
        request.techniques = {Technique::TiledDeferred}; // draws once per channel: the fastest of one G-buffer
        request.settings = truth.settings();
        request.settings.shadowSamples = point.settings.shadowSamples; // both sides have the same noise
        request.settings.layout = point.settings.layout;
        request.settings.display = true; // the comparison shows its pictures too
        const ComparePair pair = compareTechniques(truth.renderer(), gl, request).record.pairs.front();
        lines.push_back(lineOf("layout", fmt::format("layout {}", point.key.layout), "forward", pair.figures));
        for (const ChannelShare& channel : pair.channels)
            lines.push_back({"layout",
                             fmt::format("{}: {}", point.key.layout, channel.channel),
                             "that channel in fp32",
                             channel.share,
                             {},
                             {}});
    }
}

} // namespace

std::vector<AttributionLine> attributeErrors(const gpu::Capabilities& gl, const GroupTruth& truth,
                                             const std::string& truthName, std::span<const BenchPoint> points) {
    std::vector<AttributionLine> lines;
    const Picture exact = truth.pictureOf(Technique::Forward, truth.settings());
    addFilter(truth, truthName, exact, points.front(), lines);
    addShadows(truth, exact, points, lines);
    addSubsurfaces(truth, truthName, points, lines);
    addEnvironments(truth, truthName, points, lines);
    addAreas(truth, truthName, points, lines);
    addRanges(truth, points, lines);
    addLayouts(gl, truth, points, lines);
    return lines;
}

} // namespace tessera::validation
