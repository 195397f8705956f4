#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "validation/bench/BenchRecord.h"
#include "validation/bench/Pareto.h"

namespace tessera::validation {

namespace {

/// RFC 4180: quotes around fields with a separator, quotes in them doubled.
std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string result(1, '"');
    for (const char c : text) {
        if (c == '"') result += c;
        result += c;
    }
    result += '"';
    return result;
}

template <typename T>
std::string orEmpty(const std::optional<T>& value) {
    return value ? fmt::format("{}", *value) : "";
}

struct Column {
    std::string_view name;
    std::function<std::string(const BenchGroup&, const BenchResult&, std::optional<bool> pareto)> text;
};

template <typename Figure>
Column errorColumn(const char* name, Figure BenchError::*figure) {
    return {name, [figure](const BenchGroup&, const BenchResult& result, std::optional<bool>) {
                return result.error ? orEmpty((*result.error).*figure) : "";
            }};
}

template <typename Figure>
Column counterColumn(const char* name, std::optional<Figure> BenchCounters::*figure) {
    return {name, [figure](const BenchGroup&, const BenchResult& result, std::optional<bool>) {
                return orEmpty(result.counters.*figure);
            }};
}

Column counterColumn(const char* name, std::uint64_t BenchCounters::*figure) {
    return {name, [figure](const BenchGroup&, const BenchResult& result, std::optional<bool>) {
                return fmt::format("{}", result.counters.*figure);
            }};
}

/// A column with a method's name, or with `name` one of its settings.
Column methodColumn(MethodKind kind, std::optional<std::string_view> name = {}) {
    return {name.value_or(infoOf(kind).key),
            [kind, name](const BenchGroup&, const BenchResult& result, std::optional<bool>) {
                const std::optional<MethodKey>& key = result.key.method(kind);
                const std::string* const text = !key ? nullptr : name ? key->text(*name) : &key->name;
                return text ? *text : "";
            }};
}

std::vector<Column> makeColumns() {
    using G = BenchGroup;
    using R = BenchResult;
    using P = std::optional<bool>;
    std::vector<Column> table{
        {"scene", [](const G& g, const R&, P) { return quoted(g.scene); }},
        {"technique", [](const G&, const R& r, P) { return r.key.technique; }},
        {"culling", [](const G&, const R& r, P) { return r.key.culling; }},
        {"tile", [](const G&, const R& r, P) { return orEmpty(r.key.tilePixels); }},
        {"cullOn", [](const G&, const R& r, P) { return r.builder.value_or(""); }},
        {"cullNormals", [](const G&, const R& r, P) { return r.normalTest.value_or(""); }},
        {"lightOn", [](const G&, const R& r, P) { return r.key.lightOn.value_or(""); }},
        {"layout", [](const G&, const R& r, P) { return r.key.layout; }},
        {"range", [](const G&, const R& r, P) { return fmt::format("{}", r.key.rangeTolerance); }},
        {"lights", [](const G& g, const R&, P) { return fmt::format("{}", g.lights); }},
        {"width", [](const G& g, const R&, P) { return fmt::format("{}", g.sizePixels.x); }},
        {"height", [](const G& g, const R&, P) { return fmt::format("{}", g.sizePixels.y); }},
        {"cpuMsMedian", [](const G&, const R& r, P) { return fmt::format("{}", r.times.cpuMs.median); }},
        {"cpuMsP95", [](const G&, const R& r, P) { return fmt::format("{}", r.times.cpuMs.p95); }},
        {"gpuMsMedian",
         [](const G&, const R& r, P) { return r.times.gpuMs ? fmt::format("{}", r.times.gpuMs->median) : ""; }},
        {"floorMs", [](const G&, const R& r, P) { return orEmpty(r.floorMs); }},
        {"ratioToFloor", [](const G&, const R& r, P) { return orEmpty(r.ratioToFloor); }},
        {"floorLitMs", [](const G&, const R& r, P) { return orEmpty(r.floorLitMs); }},
        {"ratioToLitFloor", [](const G&, const R& r, P) { return orEmpty(r.ratioToLitFloor); }},
        {"against", [](const G& g, const R&, P) { return g.truth; }},
        errorColumn("relMse", &BenchError::relMse),
        errorColumn("maxRel", &BenchError::maxRel),
        errorColumn("p99Rel", &BenchError::p99Rel),
        errorColumn("p999Rel", &BenchError::p999Rel),
        errorColumn("flip", &BenchError::flip),
        errorColumn("bias", &BenchError::bias),
        {"pareto", [](const G&, const R&, P pareto) { return pareto ? std::string(*pareto ? "1" : "0") : ""; }},
        counterColumn("lightEvaluations", &BenchCounters::lightEvaluations),
        counterColumn("neededEvaluations", &BenchCounters::neededEvaluations),
        counterColumn("neededLitEvaluations", &BenchCounters::neededLitEvaluations),
        counterColumn("tightness", &BenchCounters::tightness),
        counterColumn("fragments", &BenchCounters::fragments),
        counterColumn("listEntries", &BenchCounters::listEntries),
        counterColumn("listBytes", &BenchCounters::listBytes),
        counterColumn("gbufferBytes", &BenchCounters::gbufferBytes),
        counterColumn("triangles", &BenchCounters::triangles),
        counterColumn("draws", &BenchCounters::draws),
    };
    std::vector<Column> methods;
    for (const MethodKindInfo& info : methodKindTable()) {
        methods.push_back(methodColumn(info.kind));
        for (const MethodSetting& row : info.settings) methods.push_back(methodColumn(info.kind, row.key));
    }
    table.insert(std::ranges::find(table, std::string_view("lights"), &Column::name), methods.begin(), methods.end());
    return table;
}

const std::vector<Column>& columns() {
    static const std::vector<Column> table = makeColumns();
    return table;
}

} // namespace

std::string benchCsv(const BenchRecord& record) {
    std::string csv;
    const auto addLine = [&csv](auto&& textOf) {
        for (const Column& column : columns()) {
            if (&column != &columns().front()) csv += ',';
            csv += textOf(column);
        }
        csv += "\r\n";
    };
    addLine([](const Column& column) { return std::string(column.name); });
    for (const BenchGroup& group : record.groups) {
        const std::vector<std::optional<bool>> pareto = paretoFront(group);
        for (std::size_t i = 0; i < group.results.size(); ++i)
            addLine([&](const Column& column) { return column.text(group, group.results[i], pareto[i]); });
    }
    return csv;
}

} // namespace tessera::validation
