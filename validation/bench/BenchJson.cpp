#include "validation/bench/BenchJson.h"

#include <cmath>

#include <fmt/format.h>

#include "base/Error.h"
#include "validation/bench/BenchJsonTerms.h"
#include "validation/bench/Pareto.h"

namespace tessera::validation {

namespace {

template <typename T>
T valueFrom(const Json& json) {
    if constexpr (std::integral<T> && !std::same_as<T, bool>)
        return wholeNumber<T>(json);
    else
        return json.get<T>();
}

template <typename T>
void read(const Json& json, const char* name, T& value) {
    value = valueFrom<T>(json.at(name));
}

template <typename T>
void read(const Json& json, const char* name, std::optional<T>& value) {
    const Json& found = json.at(name);
    if (found.is_null())
        value.reset();
    else
        value = valueFrom<T>(found);
}

Json spreadJson(const std::optional<TimeSpread>& spread) {
    if (!spread) return nullptr;
    return {{"median", spread->median}, {"p95", spread->p95}};
}

std::optional<TimeSpread> spreadFrom(const Json& json) {
    if (json.is_null()) return {};
    return TimeSpread{json.at("median").get<double>(), json.at("p95").get<double>()};
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

BenchCounters countersFrom(const Json& json) {
    BenchCounters c;
    read(json, "lightEvaluations", c.lightEvaluations);
    read(json, "neededEvaluations", c.neededEvaluations);
    read(json, "neededLitEvaluations", c.neededLitEvaluations);
    read(json, "tightness", c.tightness);
    read(json, "evaluatedMean", c.evaluatedMean);
    read(json, "evaluatedP99", c.evaluatedP99);
    read(json, "evaluatedMax", c.evaluatedMax);
    read(json, "falseNegatives", c.falseNegatives);
    read(json, "listEntries", c.listEntries);
    read(json, "listBytes", c.listBytes);
    read(json, "gbufferBytes", c.gbufferBytes);
    read(json, "fragments", c.fragments);
    read(json, "triangles", c.triangles);
    read(json, "draws", c.draws);
    return c;
}

Json errorJson(const std::optional<BenchError>& error) {
    if (!error) return nullptr;
    return {{"relMse", orNull(error->relMse)}, {"maxRel", orNull(error->maxRel)}, {"p99Rel", orNull(error->p99Rel)},
            {"flip", orNull(error->flip)},     {"bias", orNull(error->bias)},     {"p999Rel", orNull(error->p999Rel)},
            {"excluded", error->excluded}};
}

std::optional<BenchError> errorFrom(const Json& json) {
    if (json.is_null()) return {};
    BenchError error;
    read(json, "relMse", error.relMse);
    read(json, "maxRel", error.maxRel);
    read(json, "p99Rel", error.p99Rel);
    read(json, "p999Rel", error.p999Rel);
    read(json, "flip", error.flip);
    read(json, "bias", error.bias);
    read(json, "excluded", error.excluded);
    return error;
}

std::optional<MethodKey> methodFrom(const Json& json, const MethodKindInfo& info) {
    const Json& name = json.at(std::string(info.key));
    if (name.is_null()) return {};
    MethodKey key{name.get<std::string>()};
    for (const MethodSetting& row : info.settings) {
        const Json& value = json.at(std::string(row.key));
        if (value.is_boolean())
            key.values.push_back({row.key, value.get<bool>() ? "on" : "off"});
        else if (!value.is_null())
            key.values.push_back({row.key, fmt::format("{}", value.get<double>())});
    }
    return key;
}

BenchResult resultFrom(const Json& json) {
    BenchResult result;
    read(json, "technique", result.key.technique);
    read(json, "culling", result.key.culling);
    read(json, "tile", result.key.tilePixels);
    read(json, "layout", result.key.layout);
    read(json, "lightOn", result.key.lightOn);
    read(json, "range", result.key.rangeTolerance);
    for (const MethodKindInfo& info : methodKindTable()) result.key.method(info.kind) = methodFrom(json, info);
    read(json, "cullOn", result.builder);
    read(json, "cullNormals", result.normalTest);
    result.times.cpuMs = spreadFrom(json.at("cpuMs")).value();
    result.times.gpuMs = spreadFrom(json.at("gpuMs"));
    for (const Json& pass : json.at("passes")) {
        PassTime& time = result.times.passes.emplace_back();
        read(pass, "name", time.name);
        read(pass, "gpuMs", time.gpuMs);
    }
    result.counters = countersFrom(json.at("counters"));
    read(json, "floorMs", result.floorMs);
    read(json, "ratioToFloor", result.ratioToFloor);
    read(json, "floorLitMs", result.floorLitMs);
    read(json, "ratioToLitFloor", result.ratioToLitFloor);
    result.error = errorFrom(json.at("error"));
    read(json, "why", result.why);
    return result;
}

LowerBoundFigures lowerBoundFrom(const Json& json) {
    LowerBoundFigures lowerBound;
    read(json, "geometryMs", lowerBound.geometryMs);
    read(json, "geometryMsP95", lowerBound.geometryMsP95);
    read(json, "rounds", lowerBound.rounds);
    read(json, "why", lowerBound.whyNoStores);
    for (const Json& store : json.at("stores")) {
        const std::string name = store.at("store").get<std::string>();
        bool isKnown = false;
        for (const LightStoreInfo& info : lightStoreTable()) {
            if (info.name != name) continue;
            lowerBound.stores.push_back(
                {info.name, store.at("nsPerPair").get<double>(), store.at("nsPerPairP95").get<double>()});
            isKnown = true;
        }
        if (!isKnown) throw InputError(fmt::format("unknown light store '{}'", name));
    }
    return lowerBound;
}

Json picturesJson(const BenchGroup& group) {
    Json pictures = Json::array();
    for (const BenchPicture& picture : group.pictures)
        pictures.push_back({{"name", picture.name},
                            {"points", picture.points},
                            {"file", picture.file},
                            {"heatMap", picture.heatMapFile},
                            {"hash", picture.hash}});
    return pictures;
}

} // namespace

Json choicesJson(const PointKey& key) {
    Json json;
    for (const MethodKindInfo& info : methodKindTable()) {
        const std::optional<MethodKey>& method = key.method(info.kind);
        json[std::string(info.key)] = method ? Json(method->name) : Json(nullptr);
        for (const MethodSetting& row : info.settings) { // numbers, or true and false
            const std::string* const text = method ? method->text(row.key) : nullptr;
            const bool isSwitch = text && (*text == "on" || *text == "off");
            json[std::string(row.key)] = !text ? Json(nullptr) : isSwitch ? Json(*text == "on") : Json::parse(*text);
        }
    }
    return json;
}

Json pointJson(const BenchGroup& group, const BenchResult& result, std::optional<bool> pareto) {
    Json passes = Json::array();
    for (const PassTime& pass : result.times.passes)
        passes.push_back({{"name", pass.name}, {"gpuMs", orNull(pass.gpuMs)}});
    std::map<std::string, std::string> why = result.why;
    if (!result.key.tilePixels) why["tile"] = why["cullOn"] = why["cullNormals"] = "no light lists";
    if (!result.key.lightOn) why["lightOn"] = "the technique lights in fragment shaders only";
    for (const MethodKindInfo& info : methodKindTable()) {
        const std::optional<MethodKey>& method = result.key.method(info.kind);
        if (!method) why[std::string(info.key)] = info.absent;
        const bool isOff = method && method->name == info.off && !info.offAbsent.empty();
        for (const MethodSetting& row : info.settings)
            if (!method || !method->text(row.key))
                why[std::string(row.key)] = !method ? info.absent : isOff ? info.offAbsent : row.absent;
    }
    if (!result.error && !why.contains("error")) why["error"] = "not measured yet";
    if (!pareto) why["pareto"] = result.error ? "the error could not be measured" : why["error"];
    Json json = {{"scene", group.scene},
                 {"technique", result.key.technique},
                 {"culling", result.key.culling},
                 {"tile", orNull(result.key.tilePixels)},
                 {"cullOn", orNull(result.builder)},
                 {"cullNormals", orNull(result.normalTest)},
                 {"lightOn", orNull(result.key.lightOn)},
                 {"layout", result.key.layout},
                 {"range", result.key.rangeTolerance}};
    json.update(choicesJson(result.key));
    json.update({{"lights", group.lights},
                 {"size", {group.sizePixels.x, group.sizePixels.y}},
                 {"gpuMs", spreadJson(result.times.gpuMs)},
                 {"cpuMs", spreadJson(result.times.cpuMs)},
                 {"passes", passes},
                 {"counters", countersJson(result.counters)},
                 {"floorMs", orNull(result.floorMs)},
                 {"ratioToFloor", orNull(result.ratioToFloor)},
                 {"floorLitMs", orNull(result.floorLitMs)},
                 {"ratioToLitFloor", orNull(result.ratioToLitFloor)},
                 {"error", errorJson(result.error)},
                 {"against", group.truth},
                 {"pareto", orNull(pareto)},
                 {"why", why}});
    return json;
}

Json lowerBoundJson(const BenchGroup& group) {
    Json stores = Json::array();
    for (const LowerBoundFigures::Store& store : group.lowerBound.stores)
        stores.push_back({{"store", store.name}, {"nsPerPair", store.nsPerPair}, {"nsPerPairP95", store.nsPerPairP95}});
    const std::optional<LowerBoundFigures::Store> fastest = group.lowerBound.fastestStore();
    return {{"scene", group.scene},
            {"lights", group.lights},
            {"size", {group.sizePixels.x, group.sizePixels.y}},
            {"rounds", group.lowerBound.rounds},
            {"geometryMs", group.lowerBound.geometryMs},
            {"geometryMsP95", group.lowerBound.geometryMsP95},
            {"nsPerPair", fastest ? Json(fastest->nsPerPair) : Json(nullptr)},
            {"nsPerPairP95", fastest ? Json(fastest->nsPerPairP95) : Json(nullptr)},
            {"stores", stores},
            {"why", group.lowerBound.whyNoStores}};
}

Json attributionJson(const BenchGroup& group) {
    Json lines = Json::array();
    for (const AttributionLine& line : group.attribution)
        lines.push_back({{"scene", group.scene},
                         {"lights", group.lights},
                         {"size", {group.sizePixels.x, group.sizePixels.y}},
                         {"cause", line.cause},
                         {"what", line.what},
                         {"against", line.against},
                         {"relMse", orNull(line.relMse)},
                         {"p99Rel", orNull(line.p99Rel)},
                         {"bias", orNull(line.bias)}});
    return lines;
}

Json groupJson(const BenchGroup& group) {
    const std::vector<std::optional<bool>> pareto = paretoFront(group);
    Json points = Json::array();
    for (std::size_t i = 0; i < group.results.size(); ++i)
        points.push_back(pointJson(group, group.results[i], pareto[i]));
    return {
        {"scene", group.scene},           {"lights", group.lights}, {"size", {group.sizePixels.x, group.sizePixels.y}},
        {"triangles", group.triangles},   {"truth", group.truth},   {"whyTruth", group.whyTruth},
        {"floor", lowerBoundJson(group)}, {"points", points},       {"attribution", attributionJson(group)},
        {"pictures", picturesJson(group)}};
}

BenchGroup groupFromJson(const Json& json) {
    BenchGroup group;
    read(json, "scene", group.scene);
    read(json, "lights", group.lights);
    group.sizePixels = {wholeNumber<int>(json.at("size").at(0)), wholeNumber<int>(json.at("size").at(1))};
    read(json, "triangles", group.triangles);
    read(json, "truth", group.truth);
    read(json, "whyTruth", group.whyTruth);
    group.lowerBound = lowerBoundFrom(json.at("floor"));
    for (const Json& point : json.at("points")) group.results.push_back(resultFrom(point));
    for (const Json& line : json.at("attribution")) {
        AttributionLine& cause = group.attribution.emplace_back();
        read(line, "cause", cause.cause);
        read(line, "what", cause.what);
        read(line, "against", cause.against);
        read(line, "relMse", cause.relMse);
        read(line, "p99Rel", cause.p99Rel);
        read(line, "bias", cause.bias);
    }
    for (const Json& entry : json.at("pictures")) {
        BenchPicture& picture = group.pictures.emplace_back();
        read(entry, "name", picture.name);
        read(entry, "points", picture.points);
        read(entry, "file", picture.file);
        read(entry, "heatMap", picture.heatMapFile);
        read(entry, "hash", picture.hash);
    }
    return group;
}

} // namespace tessera::validation
