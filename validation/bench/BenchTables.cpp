#include "validation/bench/BenchTables.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>

#include <fmt/format.h>

#include "base/Milliseconds.h"
#include "validation/bench/Pareto.h"
#include "validation/bench/Recommend.h"
#include "validation/bench/ScalingFit.h"
#include "validation/report/FigureHtml.h"
#include "validation/report/Html.h"

namespace tessera::validation {

namespace {

std::string headHtml(std::initializer_list<const char*> titles) {
    std::string html = "<table>\n<thead><tr>";
    for (const char* title : titles) html += fmt::format("<th scope=\"col\">{}</th>", title);
    return html + "</tr></thead>\n<tbody>\n";
}

std::string cellHtml(const char* label, const std::string& html) {
    return fmt::format("<td class=\"number\" data-label=\"{}\"><span>{}</span></td>\n", label, html);
}

std::string orDash(const std::optional<double>& value, const char* format) {
    return value ? fmt::format(fmt::runtime(format), *value) : "&ndash;";
}

const char* speedClass(double speedup) {
    return speedup >= 1.0 ? "faster" : "slower";
}

/// The length of a bar for a relMse, in percent: 0 at 1e-12, 100 at 1, logarithmic between.
double barPercent(double relMse) {
    constexpr double kDecades = 12.0;
    return relMse > 0.0 ? 100.0 * std::clamp(1.0 + std::log10(relMse) / kDecades, 0.0, 1.0) : 0.0;
}

} // namespace

std::string answersHtml(const BenchRecord& record) {
    if (record.groups.size() < 2) return "";
    std::string html = "<section id=\"answers\">\n<h2>What to take</h2>\n" +
                       headHtml({"Scene", "Take", "ms a frame", "Against forward", "relMSE", "To lower bound"});
    for (const BenchGroup& group : record.groups) {
        const std::optional<Recommendation> choice = recommendFor(group);
        if (!choice) continue;
        const BenchResult& best = *choice->best;
        const std::string name = escapedHtml(pointName(best.key));
        html += fmt::format("<tr><th scope=\"row\">{}</th>\n<td data-label=\"Take\">{}</td>\n",
                            escapedHtml(groupName(group)),
                            choice->caveat.empty() ? fmt::format("<strong>{}</strong>", name)
                                                   : fmt::format("{}; ahead: {}", choice->caveat, name));
        html += cellHtml("ms a frame", millisecondsText(best.times.cpuMs.median));
        html +=
            cellHtml("Against forward", choice->speedup ? fmt::format("<span class=\"{}\">{:.2f}&times;</span>",
                                                                      speedClass(*choice->speedup), *choice->speedup)
                                                        : "&ndash;");
        html += cellHtml("relMSE", figureHtml(best.error ? best.error->relMse : std::nullopt));
        html += cellHtml("To lower bound", orDash(best.ratioToFloor, "{:.2f}")) + "</tr>\n";
    }
    return html + "</tbody>\n</table>\n</section>\n";
}

/// Separate from the table of errors, since filtering is not an error.
std::string filterHtml(const AttributionLine& line) {
    return fmt::format(
        "<p class=\"lede\">Not an error: timed frames use mipmaps; errors are measured on the finest level only, "
        "exactly "
        "filtered. The two pictures differ by relMSE {}, p99 rel {}, bias {}. How well the driver filters is another "
        "question: <code>{}</code> answers it with the pair (hardware filter), whose reference filters with the same "
        "levels.</p>\n",
        figureHtml(line.relMse), figureHtml(line.p99Rel), figureHtml(line.bias),
        escapedWhole("tessera compare SCENE --against reference"));
}

std::string attributionHtml(const BenchGroup& group) {
    if (group.attribution.empty()) return "";
    std::string html = fmt::format("<h3>{}</h3>\n", escapedHtml(groupName(group))) +
                       headHtml({"Cause", "Against", "relMSE", "", "p99 rel", "Bias"});
    for (const AttributionLine& line : group.attribution) {
        if (line.cause == kFilterCause) continue;
        html += fmt::format("<tr><th scope=\"row\">{}</th>\n<td data-label=\"Against\">{}</td>\n",
                            escapedWhole(line.what), escapedWhole(line.against));
        html += cellHtml("relMSE", figureHtml(line.relMse));
        html += fmt::format("<td class=\"bar\"><span class=\"{}\" style=\"width:{:.1f}%\"></span></td>\n", line.cause,
                            barPercent(line.relMse.value_or(0.0)));
        html += cellHtml("p99 rel", figureHtml(line.p99Rel)) + cellHtml("Bias", figureHtml(line.bias)) + "</tr>\n";
    }
    html += "</tbody>\n</table>\n";
    for (const AttributionLine& line : group.attribution)
        if (line.cause == kFilterCause) html += filterHtml(line);
    return html;
}

std::string pointsHtml(const BenchGroup& group) {
    const bool hasRange = std::any_of(group.results.begin(), group.results.end(),
                                      [](const BenchResult& result) { return result.key.rangeTolerance > 0.0; });
    const bool hasFlip = std::any_of(group.results.begin(), group.results.end(),
                                     [](const BenchResult& result) { return result.error && result.error->flip; });
    std::string html = headHtml({"Technique", "Culling", "Layout"});
    html.erase(html.rfind("</tr>"));
    const bool hasCompute = std::any_of(group.results.begin(), group.results.end(),
                                        [](const BenchResult& result) { return result.key.isLitByCompute(); });
    std::vector<std::pair<MethodKind, std::string>> kinds; // with their titles
    for (const MethodKindInfo& info : methodKindTable()) {
        std::string title(info.title);
        title[0] = char(std::toupper(static_cast<unsigned char>(title[0])));
        if (std::ranges::any_of(group.results,
                                [&](const BenchResult& result) { return result.key.method(info.kind).has_value(); }))
            kinds.emplace_back(info.kind, std::move(title));
    }
    if (hasCompute) html += "<th scope=\"col\">Lit on</th>";
    if (hasRange) html += "<th scope=\"col\">Range</th>";
    for (const auto& [kind, title] : kinds) html += fmt::format("<th scope=\"col\">{}</th>", title);
    for (const char* title :
         {"ms a frame", "p95", "To lower bound", "To lit lower bound", "Visited", "relMSE", "p99 rel", "Bias"})
        html += fmt::format("<th scope=\"col\">{}</th>", title);
    if (hasFlip) html += "<th scope=\"col\">FLIP</th>";
    html += "<th scope=\"col\">Front</th></tr></thead>\n<tbody>\n";
    const std::vector<std::optional<bool>> pareto = paretoFront(group);
    std::vector<std::size_t> order(group.results.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return group.results[a].times.cpuMs.median < group.results[b].times.cpuMs.median;
    });
    for (const std::size_t i : order) {
        const BenchResult& result = group.results[i];
        const PointKey& key = result.key;
        const BenchError error = result.error.value_or(BenchError{});
        const bool isOnFront = pareto[i].value_or(false);
        html += fmt::format("<tr{}><th scope=\"row\">{}</th>\n<td data-label=\"Culling\">{}</td>\n"
                            "<td data-label=\"Layout\">{}</td>\n",
                            isOnFront ? " class=\"front\"" : "", escapedHtml(key.technique),
                            key.tilePixels ? fmt::format("{} {}", key.culling, *key.tilePixels) : "&ndash;",
                            escapedHtml(key.layout));
        if (hasCompute) html += fmt::format("<td data-label=\"Lit on\">{}</td>\n", key.lightOn.value_or("&ndash;"));
        if (hasRange)
            html += cellHtml("Range", key.rangeTolerance > 0.0 ? fmt::format("{:g}", key.rangeTolerance) : "&ndash;");
        for (const auto& [kind, title] : kinds) {
            const std::optional<MethodKey>& method = key.method(kind);
            html += fmt::format("<td data-label=\"{}\">{}</td>\n", title,
                                method ? escapedHtml(methodText(kind, *method)) : "&ndash;");
        }
        html += cellHtml("ms a frame", fmt::format("{:.1f}", result.times.cpuMs.median)) +
                cellHtml("p95", fmt::format("{:.1f}", result.times.cpuMs.p95)) +
                cellHtml("To lower bound", orDash(result.ratioToFloor, "{:.2f}")) +
                cellHtml("To lit lower bound", orDash(result.ratioToLitFloor, "{:.2f}")) +
                cellHtml("Visited", orDash(result.counters.evaluatedMean, "{:.1f}")) +
                cellHtml("relMSE", figureHtml(error.relMse)) + cellHtml("p99 rel", figureHtml(error.p99Rel)) +
                cellHtml("Bias", figureHtml(error.bias));
        if (hasFlip) html += cellHtml("FLIP", figureHtml(error.flip));
        html += cellHtml("Front", isOnFront ? "&#9679;" : "") + "</tr>\n";
    }
    return html + "</tbody>\n</table>\n";
}

std::string fitsHtml(std::span<const BenchGroup> groups) {
    std::string rows;
    for (const ScalingCurve& curve : scalingCurves(groups)) {
        if (!curve.fit) continue;
        rows += fmt::format("<tr><th scope=\"row\">{}</th>\n<td data-label=\"Against\">{}{}</td>\n",
                            escapedHtml(curve.scene + ": " + pointName(curve.key)), curve.quantity,
                            curve.held.empty() ? "" : " at " + escapedHtml(curve.held));
        rows += cellHtml("Exponent", curve.fit->isTrend() ? fmt::format("{:.2f}", curve.fit->exponent) : "no trend") +
                cellHtml("R&sup2;", fmt::format("{:.3f}", curve.fit->r2)) +
                cellHtml("Most off", fmt::format("{:.0f}&nbsp;%", 100.0 * curve.fit->mostOff)) +
                cellHtml("Points", fmt::format("{}", curve.fit->points)) + "</tr>\n";
    }
    if (rows.empty()) return "";
    return "<details><summary>Fitted exponents: time grows as the quantity to this power</summary>\n" +
           headHtml({"Point", "Against", "Exponent", "R&sup2;", "Most off", "Points"}) + rows +
           "</tbody>\n</table>\n</details>\n";
}

} // namespace tessera::validation
