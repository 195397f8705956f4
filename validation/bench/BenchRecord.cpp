#include "validation/bench/BenchRecord.h"

#include <algorithm>

#include <fmt/format.h>

#include "renderer/graph/Table.h"
#include "validation/bench/BenchJson.h"
#include "validation/bench/BenchJsonTerms.h"
#include "validation/bench/Pareto.h"
#include "validation/bench/Recommend.h"
#include "validation/bench/ScalingFit.h"
#include "validation/figures/FigureText.h"

namespace tessera::validation {

namespace {

constexpr std::size_t kTableWidth = 120;

std::string figure(const std::optional<double>& value, const char* format) {
    return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

Json keyJson(const PointKey& key) {
    Json json = {{"technique", key.technique},     {"culling", key.culling}, {"tile", orNull(key.tilePixels)},
                 {"lightOn", orNull(key.lightOn)}, {"layout", key.layout},   {"range", key.rangeTolerance}};
    json.update(choicesJson(key));
    return json;
}

Json scalingJson(std::span<const BenchGroup> groups) {
    Json curves = Json::array();
    for (const ScalingCurve& curve : scalingCurves(groups)) {
        Json json = {
            {"scene", curve.scene}, {"point", keyJson(curve.key)}, {"against", curve.quantity}, {"held", curve.held},
            {"x", curve.x},         {"cpuMs", curve.timeMs},       {"exponent", nullptr},       {"r2", nullptr},
            {"mostOff", nullptr},   {"why", Json::object()}};
        if (curve.fit) {
            json["exponent"] = curve.fit->exponent;
            json["r2"] = curve.fit->r2;
            json["mostOff"] = curve.fit->mostOff;
        } else {
            json["why"]["exponent"] = "fewer than three different values";
        }
        curves.push_back(std::move(json));
    }
    return curves;
}

Json recommendationsJson(std::span<const BenchGroup> groups) {
    Json list = Json::array();
    for (const BenchGroup& group : groups) {
        const std::optional<Recommendation> choice = recommendFor(group);
        if (!choice) continue;
        const std::optional<BenchError>& error = choice->best->error;
        list.push_back({{"scene", group.scene},
                        {"lights", group.lights},
                        {"size", {group.sizePixels.x, group.sizePixels.y}},
                        {"take", keyJson(choice->best->key)},
                        {"cpuMs", choice->best->times.cpuMs.median},
                        {"speedup", orNull(choice->speedup)},
                        {"relMse", orNull(error ? error->relMse : std::nullopt)},
                        {"text", recommendationText(group)}});
    }
    return list;
}

std::string groupTable(const BenchGroup& group) {
    using graph::Table;
    const std::optional<LowerBoundFigures::Store> store = group.lowerBound.fastestStore();
    std::string text =
        fmt::format("{}; errors against {}; lower bound, median of {}: {:.1f} ms for the geometry{}\n",
                    groupName(group), group.truth, group.lowerBound.rounds, group.lowerBound.geometryMs,
                    store ? fmt::format(", {:.2f} ns a light and pixel ({})", store->nsPerPair, store->name) : "");
    Table table(kTableWidth);
    const auto any = [&](auto&& holds) {
        return std::ranges::any_of(group.results, [&](const BenchResult& result) { return holds(result.key); });
    };
    const bool hasRange = any([](const PointKey& key) { return key.rangeTolerance > 0.0; });
    const bool hasCompute = any([](const PointKey& key) { return key.isLitByCompute(); });
    std::vector<MethodKind> kinds;
    for (const MethodKindInfo& info : methodKindTable())
        if (any([&](const PointKey& key) { return key.method(info.kind).has_value(); })) kinds.push_back(info.kind);
    const bool hasLongColumn = !kinds.empty();
    // Method columns are wide: technique names stay whole, and the long title breaks.
    table.addColumn("technique", Table::Align::Left, hasLongColumn ? Table::Cells::Whole : Table::Cells::Break);
    table.addColumn("culling", Table::Align::Left, Table::Cells::Whole);
    table.addColumn("layout");
    if (hasCompute) table.addColumn("lit on");
    if (hasRange) table.addColumn("range", Table::Align::Right, Table::Cells::Whole);
    for (const MethodKind kind : kinds) table.addColumn(std::string(infoOf(kind).title));
    for (const char* title : {"ms", "p95"}) table.addColumn(title, Table::Align::Right, Table::Cells::Whole);
    table.addColumn("to lower bound", Table::Align::Right, hasLongColumn ? Table::Cells::Break : Table::Cells::Whole);
    for (const char* title : {"to lit", "visited", "relMSE", "bias"})
        table.addColumn(title, Table::Align::Right, Table::Cells::Whole);
    table.addColumn("front", Table::Align::Left, Table::Cells::Whole);
    const std::vector<std::optional<bool>> pareto = paretoFront(group);
    for (std::size_t i = 0; i < group.results.size(); ++i) {
        const BenchResult& result = group.results[i];
        const PointKey& key = result.key;
        const BenchError error = result.error.value_or(BenchError{});
        std::vector<std::string> row{
            key.technique, key.tilePixels ? fmt::format("{}, {}", key.culling, *key.tilePixels) : "none", key.layout};
        if (hasCompute) row.push_back(key.lightOn.value_or("-"));
        if (hasRange) row.push_back(key.rangeTolerance > 0.0 ? fmt::format("{:g}", key.rangeTolerance) : "-");
        for (const MethodKind kind : kinds) row.push_back(key.method(kind) ? methodText(kind, *key.method(kind)) : "-");
        for (const std::string& cell :
             {fmt::format("{:.1f}", result.times.cpuMs.median), fmt::format("{:.1f}", result.times.cpuMs.p95),
              figure(result.ratioToFloor, "{:.2f}"), figure(result.ratioToLitFloor, "{:.2f}"),
              figure(result.counters.evaluatedMean, "{:.1f}"), error.relMse ? figureText(*error.relMse) : "-",
              error.bias ? figureText(*error.bias) : "-", std::string(pareto[i].value_or(false) ? "*" : "")})
            row.push_back(cell);
        table.addRow(std::move(row));
    }
    text += table.text();
    for (const AttributionLine& line : group.attribution) {
        text += fmt::format("  {}, against {}: relMSE {}", line.what, line.against,
                            line.relMse ? figureText(*line.relMse) : "-");
        if (line.bias) text += fmt::format(", bias {}", figureText(*line.bias));
        text += "\n";
    }
    return text + "\n";
}

} // namespace

std::string benchJson(const BenchRecord& record) {
    Json points = Json::array(), lowerBounds = Json::array(), skipped = Json::array(), attribution = Json::array();
    for (const BenchGroup& group : record.groups) {
        lowerBounds.push_back(lowerBoundJson(group));
        const std::vector<std::optional<bool>> pareto = paretoFront(group);
        for (std::size_t i = 0; i < group.results.size(); ++i)
            points.push_back(pointJson(group, group.results[i], pareto[i]));
        for (Json& line : attributionJson(group)) attribution.push_back(std::move(line));
    }
    for (const SkippedPoint& point : record.skipped) skipped.push_back({{"what", point.what}, {"why", point.why}});
    const Json json = {{"schema", kBenchSchema},
                       {"machine", record.machine},
                       {"renderer", record.renderer},
                       {"driver", record.driver},
                       {"commit", record.commit},
                       {"command", record.command},
                       {"frames", record.frames},
                       {"complete", record.isComplete},
                       {"floors", lowerBounds},
                       {"points", points},
                       {"attribution", attribution},
                       {"scaling", scalingJson(record.groups)},
                       {"skipped", skipped},
                       {"recommendations", recommendationsJson(record.groups)},
                       {"recommendation", recommendationText(record.groups)}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string unfinishedText(const BenchRecord& record) {
    if (record.isComplete) return "";
    std::size_t measured = 0;
    for (const BenchGroup& group : record.groups) measured += group.results.size();
    if (record.isShare)
        return fmt::format("This machine measured {} of {} points. Others measured the rest.", measured,
                           record.plannedPoints);
    return fmt::format("Unfinished: {} of {} points are measured, and figures and recommendations may change with the "
                       "others. {}.",
                       measured, record.plannedPoints,
                       record.shards > 1 ? "Resume every shard until it is finished, then merge them"
                                         : "Resume it to finish");
}

std::string benchTable(const BenchRecord& record) {
    std::string text;
    for (const BenchGroup& group : record.groups) text += groupTable(group);
    for (const ScalingCurve& curve : scalingCurves(record.groups)) {
        if (!curve.fit || curve.quantity == "evaluations") continue; // these are only in the files
        const std::string growth = curve.fit->isTrend()
                                       ? fmt::format("time grows as {}^{:.2f}", curve.quantity, curve.fit->exponent)
                                       : fmt::format("no trend of time with {}", curve.quantity);
        text += fmt::format("{}, {}: {}{} (R2 {:.3f}, {} points)\n", curve.scene, pointName(curve.key), growth,
                            curve.held.empty() ? "" : " at " + curve.held, curve.fit->r2, curve.fit->points);
    }
    for (const SkippedPoint& point : record.skipped) text += fmt::format("skipped {}: {}\n", point.what, point.why);
    for (const BenchGroup& group : record.groups) {
        const std::string words = recommendationText(group);
        if (!words.empty()) text += words + "\n";
    }
    if (!record.isComplete) text += unfinishedText(record) + "\n";
    return text;
}

} // namespace tessera::validation
