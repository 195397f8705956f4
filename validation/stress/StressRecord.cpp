#include "validation/stress/StressRecord.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "validation/figures/FigureText.h"

namespace tessera::validation {

namespace {

using Json = nlohmann::ordered_json;

std::string techniqueName(const StressResult& result) {
    return result.technique ? std::string(infoOf(*result.technique).name) : "";
}

Json resultJson(const StressResult& result) {
    const StressFigures& figures = result.figures;
    Json json = {{"name", result.name},
                 {"technique", result.technique ? Json(techniqueName(result)) : Json(nullptr)},
                 {"samples", figures.samples},
                 {"nan", figures.nan},
                 {"inf", figures.infinite},
                 {"negative", figures.negative},
                 {"worstRel", figureJson(figures.worstRel)},
                 {"tolerance", result.tolerance},
                 {"ok", result.ok()},
                 {"toleranceOf", result.bound == StressBound::WorstRel ? "worstRel" : "relMse"},
                 {"relMse", result.technique ? figureJson(figures.worstRelMse) : Json(nullptr)},
                 {"undecided", figures.undecided},
                 {"where", figures.where},
                 {"missed", result.missed()},
                 {"reason", result.reason}};
    Json why = Json::object();
    if (!result.technique) {
        why["technique"] = "shader functions alone, which all techniques share";
        why["relMse"] = "no picture is drawn";
    } else if (json["relMse"].is_null()) {
        why["relMse"] = "no pixel could be compared";
    }
    if (json["worstRel"].is_null()) why["worstRel"] = "it is not finite";
    json["why"] = why;
    return json;
}

using Row = std::vector<std::string>;

Row rowOf(const StressResult& result) {
    const StressFigures& figures = result.figures;
    return {result.name,
            result.technique ? techniqueName(result) : "-",
            fmt::format("{}", figures.samples),
            fmt::format("{}/{}/{}", figures.nan, figures.infinite, figures.negative),
            (result.bound == StressBound::RelMse ? "relMSE " : "") + figureText(result.held()),
            figureText(result.tolerance),
            result.ok() ? "ok" : "MISSED"};
}

} // namespace

bool StressRecord::ok() const {
    return !results.empty() &&
           std::all_of(results.begin(), results.end(), [](const StressResult& result) { return result.ok(); });
}

std::string stressJson(const StressRecord& record) {
    Json cases = Json::array();
    for (const StressResult& result : record.results) cases.push_back(resultJson(result));
    const Json json = {{"schema", 1},
                       {"renderer", record.renderer},
                       {"effort", record.effort == StressEffort::Full ? "full" : "quick"},
                       {"ok", record.ok()},
                       {"cases", cases}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string stressTable(const StressRecord& record) {
    std::vector<Row> rows = {{"case", "technique", "samples", "nan/inf/neg", "worst rel", "at most", "verdict"}};
    for (const StressResult& result : record.results) rows.push_back(rowOf(result));
    std::string text = record.renderer + "\n" + textTable(rows, 2);
    std::size_t missedCount = 0;
    for (const StressResult& result : record.results) {
        missedCount += !result.ok();
        for (const std::string& missed : result.missed())
            text += fmt::format("missed: {}{}: {}\n", result.name,
                                result.technique ? " with " + techniqueName(result) : "", missed);
    }
    std::uint64_t samples = 0;
    for (const StressResult& result : record.results) samples += result.figures.samples;
    text += missedCount == 0 ? fmt::format("all {} hold over {} samples\n", record.results.size(), samples)
                             : fmt::format("{} of {} missed\n", missedCount, record.results.size());
    return text;
}

std::string stressList() {
    std::size_t width = 0;
    for (const StressCase& row : stressCases()) width = std::max(width, row.name.size());
    std::string text;
    for (const StressCase& row : stressCases()) text += fmt::format("{:<{}}  {}\n", row.name, width, row.holds);
    return text;
}

} // namespace tessera::validation
