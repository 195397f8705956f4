#include "validation/bench/Attribution.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

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

void addFilter(const GroupTruth& truth, const std::string& truthName, const BenchPoint& any,
               std::vector<AttributionLine>& lines) {
    const Picture exact = truth.pictureOf(Technique::Forward, exactSettings(any.settings, truth.filter()));
    lines.push_back(lineOf("arithmetic", "fp32 arithmetic of forward", truthName,
                           radianceFigures(exact, truth.pictureFor(exact), truth.excluded())));
    // Nothing was chosen where the timed frames filter exactly too.
    if (any.settings.filter == frame::TextureFilter::Exact || truth.filter() != frame::TextureFilter::Exact ||
        !frame::materialFeatures(truth.renderer().scene()).textures())
        return;
    frame::FrameSettings hardware = exactSettings(any.settings, frame::TextureFilter::Hardware);
    const engine::RenderedFrame frame = truth.renderer().render(Technique::Forward, hardware);
    Picture filtered = exact; // the same pixels are covered
    filtered.rgba = frame.radiance;
    lines.push_back(lineOf(kFilterCause, "smaller texture levels, hardware filter", "level 0 alone, exact filter",
                           radianceFigures(filtered, exact)));
}

void addRanges(const GroupTruth& truth, std::span<const BenchPoint> points, std::vector<AttributionLine>& lines) {
    std::set<double> tolerances;
    for (const BenchPoint& point : points) tolerances.insert(point.settings.rangeTolerance);
    for (const double tolerance : tolerances) {
        if (tolerance == 0.0) continue;
        frame::FrameSettings settings = exactSettings(points.front().settings, truth.filter());
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
        request.settings = exactSettings(point.settings, truth.filter());
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
    addFilter(truth, truthName, points.front(), lines);
    addRanges(truth, points, lines);
    addLayouts(gl, truth, points, lines);
    return lines;
}

} // namespace tessera::validation
