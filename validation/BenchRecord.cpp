#include "validation/BenchRecord.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/utsname.h>

#include "renderer/graph/Table.h"

namespace tessera::validation {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kTableWidth = 120;

template <typename T>
Json orNull(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json spreadJson(const std::optional<TimeSpread>& spread) {
    if (!spread) return nullptr;
    return {{"median", spread->median}, {"p95", spread->p95}};
}

Json countersJson(const BenchCounters& c) {
    return {{"lightEvaluations", orNull(c.lightEvaluations)},
            {"neededEvaluations", orNull(c.neededEvaluations)},
            {"neededLitEvaluations", orNull(c.neededLitEvaluations)},
            {"tightness", orNull(c.tightness)},
            {"evaluatedMean", orNull(c.evaluatedMean)},
            {"evaluatedP99", orNull(c.evaluatedP99)},
            {"evaluatedMax", orNull(c.evaluatedMax)},
            {"falseNegatives", c.falseNegatives},
            {"listEntries", c.listEntries},
            {"listBytes", c.listBytes},
            {"gbufferBytes", c.gbufferBytes},
            {"fragments", orNull(c.fragments)},
            {"triangles", c.triangles},
            {"draws", c.draws}};
}

std::string methodName(const BenchResult& result) {
    return std::string(culling::methodTable()[std::size_t(result.culling.method)].name);
}

bool hasTiles(const BenchResult& result) {
    return result.culling.method != culling::Method::None;
}

Json pointJson(const BenchGroup& group, const BenchResult& result) {
    Json passes = Json::array();
    for (const PassTime& pass : result.times.passes)
        passes.push_back({{"name", pass.name}, {"gpuMs", orNull(pass.gpuMs)}});
    std::map<std::string, std::string> why = result.why;
    if (!hasTiles(result)) why["tile"] = why["cullOn"] = "no light lists";
    why["error"] = why["pareto"] = "times and counters only; `tessera compare` measures the error";
    return {{"scene", group.scene},
            {"technique", result.technique},
            {"culling", methodName(result)},
            {"tile", hasTiles(result) ? Json(result.culling.tilePixels) : Json(nullptr)},
            {"cullOn", hasTiles(result) ? Json(culling::builderTable()[std::size_t(result.culling.builder)].name)
                                        : Json(nullptr)},
            {"layout", result.layout},
            {"lights", group.lights},
            {"size", {group.sizePixels.x, group.sizePixels.y}},
            {"gpuMs", spreadJson(result.times.gpuMs)},
            {"cpuMs", spreadJson(result.times.cpuMs)},
            {"passes", passes},
            {"counters", countersJson(result.counters)},
            {"floorMs", orNull(result.floorMs)},
            {"ratioToFloor", orNull(result.ratioToFloor)},
            {"error", nullptr},
            {"pareto", nullptr},
            {"why", why}};
}

Json floorJson(const BenchGroup& group) {
    Json stores = Json::array();
    for (const FloorFigures::Store& store : group.floor.stores)
        stores.push_back({{"store", store.name}, {"nsPerPair", store.nsPerPair}});
    const std::optional<FloorFigures::Store> fastest = group.floor.fastestStore();
    return {{"scene", group.scene},
            {"lights", group.lights},
            {"size", {group.sizePixels.x, group.sizePixels.y}},
            {"geometryMs", group.floor.geometryMs},
            {"nsPerPair", fastest ? Json(fastest->nsPerPair) : Json(nullptr)},
            {"stores", stores},
            {"why", group.floor.whyNoStores}};
}

const BenchResult* fastestOf(const BenchGroup& group) {
    const BenchResult* best = nullptr;
    for (const BenchResult& result : group.results) {
        if (!best || result.times.cpuMs.median < best->times.cpuMs.median) best = &result;
    }
    return best;
}

const BenchResult* forwardOf(const BenchGroup& group) {
    for (const BenchResult& result : group.results) {
        if (result.point.technique == recipes::Technique::Forward) return &result;
    }
    return nullptr;
}

std::string figure(const std::optional<double>& value, const char* format) {
    return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

} // namespace

std::string benchJson(const BenchRecord& record) {
    Json points = Json::array(), floors = Json::array(), skipped = Json::array();
    for (const BenchGroup& group : record.groups) {
        floors.push_back(floorJson(group));
        for (const BenchResult& result : group.results) points.push_back(pointJson(group, result));
    }
    for (const SkippedPoint& point : record.skipped) skipped.push_back({{"what", point.what}, {"why", point.why}});
    const Json json = {{"schema", kBenchSchema},
                       {"machine", record.machine},
                       {"renderer", record.renderer},
                       {"commit", record.commit},
                       {"floors", floors},
                       {"points", points},
                       {"skipped", skipped},
                       {"recommendation", record.recommendation}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string benchTable(const BenchRecord& record) {
    using graph::Table;
    std::string text;
    for (const BenchGroup& group : record.groups) {
        const std::optional<FloorFigures::Store> store = group.floor.fastestStore();
        text +=
            fmt::format("{}, {} lights, {}x{}; floor: {:.1f} ms for the geometry{}\n", group.scene, group.lights,
                        group.sizePixels.x, group.sizePixels.y, group.floor.geometryMs,
                        store ? fmt::format(", {:.2f} ns a light and pixel ({})", store->nsPerPair, store->name) : "");
        Table table(kTableWidth);
        table.addColumn("technique");
        table.addColumn("culling", Table::Align::Left, Table::Cells::Whole);
        table.addColumn("layout");
        for (const char* title : {"ms", "p95", "to floor", "visited", "tightness", "list MB"})
            table.addColumn(title, Table::Align::Right, Table::Cells::Whole);
        for (const BenchResult& result : group.results) {
            table.addRow(
                {result.technique,
                 hasTiles(result) ? fmt::format("{}, {}", methodName(result), result.culling.tilePixels) : "none",
                 result.layout, fmt::format("{:.1f}", result.times.cpuMs.median),
                 fmt::format("{:.1f}", result.times.cpuMs.p95), figure(result.ratioToFloor, "{:.2f}"),
                 figure(result.counters.evaluatedMean, "{:.1f}"), figure(result.counters.tightness, "{:.3f}"),
                 fmt::format("{:.2f}", double(result.counters.listBytes) * 1e-6)});
        }
        text += table.text() + "\n";
    }
    for (const SkippedPoint& point : record.skipped) text += fmt::format("skipped {}: {}\n", point.what, point.why);
    return text + record.recommendation + "\n";
}

std::string recommend(const std::vector<BenchGroup>& groups) {
    std::string text;
    for (const BenchGroup& group : groups) {
        const BenchResult* best = fastestOf(group);
        if (!best) continue;
        const BenchResult* forward = forwardOf(group);
        text += fmt::format("{}{} with {} lights at {}x{}: {}", text.empty() ? "" : " ", group.scene, group.lights,
                            group.sizePixels.x, group.sizePixels.y, best->technique);
        if (hasTiles(*best)) text += fmt::format(", {}, tile {}", methodName(*best), best->culling.tilePixels);
        text += fmt::format(", {}: {:.1f} ms", best->layout, best->times.cpuMs.median);
        if (forward && forward != best)
            text +=
                fmt::format(", {:.1f}x the speed of forward", forward->times.cpuMs.median / best->times.cpuMs.median);
        if (best->ratioToFloor) text += fmt::format(", {:.2f} times the floor", *best->ratioToFloor);
        text += ".";
    }
    return text;
}

std::string machineName() {
    std::string processor = "unknown processor";
    std::ifstream cpuinfo("/proc/cpuinfo");
    for (std::string line; std::getline(cpuinfo, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) processor = line.substr(colon + 2);
    }
    utsname system{};
    uname(&system);
    return fmt::format("{} x {}, {} {}", std::thread::hardware_concurrency(), processor, system.sysname,
                       system.machine);
}

} // namespace tessera::validation
