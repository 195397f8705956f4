#include "validation/report/ReportPairs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "validation/figures/FigureText.h"
#include "validation/pictures/HeatMap.h"
#include "validation/report/FigureHtml.h"
#include "validation/report/Html.h"

namespace tessera::validation {
namespace {

std::string limitHtml(const Tolerance& tolerance) {
    std::string html;
    const auto add = [&](const std::string& part) { html += (html.empty() ? "" : ", ") + part; };
    if (tolerance.bitEqual) add("equal bits &ge;&nbsp;" + shareHtml(*tolerance.bitEqual));
    if (tolerance.maxRel) add("max&nbsp;rel &le;&nbsp;" + figureHtml(*tolerance.maxRel));
    if (tolerance.p999Rel) add("p99.9 &le;&nbsp;" + figureHtml(*tolerance.p999Rel));
    if (tolerance.relMse) add("relMSE &le;&nbsp;" + figureHtml(*tolerance.relMse));
    if (tolerance.bias) add("|bias| &le;&nbsp;" + figureHtml(*tolerance.bias));
    if (html.empty()) html = "signal and sound values only";
    if (!tolerance.reason.empty())
        html += fmt::format("<span class=\"reason\">{}</span>", escapedWhole(tolerance.reason));
    return html;
}

std::string badgeHtml(const Verdict& verdict) {
    return verdict.ok ? "<span class=\"badge ok\">&#10003; holds</span>"
                      : "<span class=\"badge missed\">&#10007; missed</span>";
}

std::string nameHtml(const ComparePair& pair) {
    return fmt::format("{} against {}", escapedHtml(pair.a), escapedHtml(pair.b));
}

std::string countsHtml(const BadPixels& bad) {
    return fmt::format("{} / {} / {}", bad.nan, bad.infinite, bad.negative);
}

std::string allFiguresHtml(const ErrorFigures& figures) {
    const auto orReason = [](const std::string& text, const std::string& reason) {
        return reason.empty() ? text : fmt::format("&ndash; <span class=\"reason\">{}</span>", escapedWhole(reason));
    };
    const std::pair<const char*, std::string> entries[] = {
        {"Equal bits", shareHtml(figures.bitEqual)},
        {"Max abs", figureHtml(figures.maxAbs)},
        {"Max rel", figureHtml(figures.maxRel)},
        {"Max rel at x, y", fmt::format("{}, {}", figures.worstX, figures.worstY)},
        {"RMSE", figureHtml(figures.rmse)},
        {"relMSE", figureHtml(figures.relMse)},
        {"Median rel", figureHtml(figures.p50Rel)},
        {"p99 rel", figureHtml(figures.p99Rel)},
        {"p99.9 rel", figureHtml(figures.p999Rel)},
        {"Bias", figureHtml(figures.bias)},
        {"PSNR", orReason(escapedHtml(decibelText(figures.psnr)), figures.psnrReason)},
        {"FLIP", orReason(figureHtml(figures.flip.value_or(0.0)), figures.flipReason)},
        {"NaN / Inf / negative", countsHtml(figures.bad)},
        {"NaN / Inf / negative, uncovered", countsHtml(figures.badOutside)},
        {"Covered pixels", countText(figures.covered)},
        {"Excluded of them", shareHtml(figures.excluded)},
        {"Lit of the compared", shareHtml(figures.litCoveredShare())},
        {"Mean luminance", figureHtml(figures.meanLuminance)}};
    std::string html = "<dl class=\"figures\">\n";
    for (const auto& [label, value] : entries) html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", label, value);
    return html + "</dl>\n";
}

/// The slider is built by report.js; `hidden` hides its place if scripts are off.
std::string sliderHtml(const Report& report, const ComparePair& pair) {
    const std::string left = pictureId(report, pair.b), right = pictureId(report, pair.a);
    if (left.empty() || right.empty()) return "";
    return fmt::format(
        "<figure data-left=\"{}\" data-right=\"{}\" data-left-name=\"{}\" data-right-name=\"{}\" hidden=\"\">\n"
        "<figcaption>Drag to compare: {} left, {} right.</figcaption>\n</figure>\n",
        left, right, escapedHtml(pair.b), escapedHtml(pair.a), escapedHtml(pair.b), escapedHtml(pair.a));
}

std::string heatMapHtml(const Report& report, const ComparePair& pair) {
    const auto found = std::find_if(report.heatMaps.begin(), report.heatMaps.end(), [&](const ReportHeatMap& heatMap) {
        return heatMap.a == pair.a && heatMap.b == pair.b;
    });
    if (found == report.heatMaps.end()) return "";
    return fmt::format(
        "<figure>\n<img width=\"{}\" height=\"{}\" alt=\"Heat map of the relative error of {}\" src=\"{}\" />\n"
        "<figcaption>Relative error, logarithmic: black agrees to fp32 rounding, at pale yellow "
        "the error is as large as the value.</figcaption>\n</figure>\n",
        found->image.width, found->image.height, nameHtml(pair), pngDataUri(found->image.bytes));
}

/// One line in place of a slider between equal pictures and a black map.
std::string viewsHtml(const Report& report, const ComparePair& pair) {
    if (pair.figures.bitEqual == 1.0) return "<p>Both pictures have the same bits in every pixel.</p>\n";
    if (showsNoError(pair.figures)) return "<p>No pixel differs by more than fp32 rounds.</p>\n";
    return sliderHtml(report, pair) + heatMapHtml(report, pair);
}

std::string channelsHtml(const ComparePair& pair) {
    if (pair.channels.empty()) return "";
    std::string shares;
    for (const ChannelShare& channel : pair.channels) {
        shares +=
            fmt::format("{}{} {}", shares.empty() ? "" : ", ", escapedHtml(channel.channel), figureHtml(channel.share));
    }
    return fmt::format(
        "<p>What each packed G-buffer channel adds to relMSE, found by storing that channel alone in fp32: {}.</p>\n",
        shares);
}

} // namespace

std::string pictureId(const Report& report, const std::string& name) {
    const auto found = std::find_if(report.pictures.begin(), report.pictures.end(),
                                    [&](const ReportPicture& picture) { return picture.name == name; });
    return found == report.pictures.end() ? "" : fmt::format("picture-{}", found - report.pictures.begin());
}

std::string pairTableHtml(const CompareRecord& record) {
    std::string html = "<table>\n<thead><tr><th scope=\"col\">Pair</th><th scope=\"col\">Result</th>"
                       "<th scope=\"col\">Equal bits</th><th scope=\"col\">Max rel</th><th scope=\"col\">p99.9 rel</th>"
                       "<th scope=\"col\">relMSE</th><th scope=\"col\">Bias</th><th scope=\"col\">Limit, and why</th>"
                       "</tr></thead>\n<tbody>\n";
    for (std::size_t i = 0; i < record.pairs.size(); ++i) {
        const ComparePair& pair = record.pairs[i];
        const ErrorFigures& figures = pair.figures;
        html +=
            fmt::format("<tr><th scope=\"row\"><a href=\"#pair-{}\">{}</a></th>\n<td data-label=\"Result\">{}</td>\n",
                        i, nameHtml(pair), badgeHtml(pair.verdict));
        const std::pair<const char*, std::string> numbers[] = {{"Equal bits", shareHtml(figures.bitEqual)},
                                                               {"Max rel", figureHtml(figures.maxRel)},
                                                               {"p99.9 rel", figureHtml(figures.p999Rel)},
                                                               {"relMSE", figureHtml(figures.relMse)},
                                                               {"Bias", figureHtml(figures.bias)}};
        for (const auto& [label, value] : numbers)
            html += fmt::format("<td class=\"number\" data-label=\"{}\"><span>{}</span></td>\n", label, value);
        html += fmt::format("<td class=\"limit\" data-label=\"Limit\"><div>{}</div></td></tr>\n",
                            limitHtml(pair.tolerance));
    }
    return html + "</tbody>\n</table>\n";
}

std::string droppedHtml(const CompareRecord& record) {
    if (!record.rangeTruncation) return "";
    const RangeTruncation& truncation = *record.rangeTruncation;
    const ErrorFigures& figures = truncation.figures;
    return fmt::format("<p>What the range tolerance {:g} drops, {} against itself without it: bias {}, relMSE {}, "
                       "p99&nbsp;rel {}.</p>\n",
                       truncation.tolerance, escapedHtml(truncation.technique), figureHtml(figures.bias),
                       figureHtml(figures.relMse), figureHtml(figures.p99Rel));
}

std::string pairHtml(const Report& report, std::size_t index) {
    const ComparePair& pair = report.record.pairs.at(index);
    std::string html = fmt::format("<article class=\"pair\" id=\"pair-{}\">\n<header><h3>{}</h3>{}</header>\n", index,
                                   nameHtml(pair), badgeHtml(pair.verdict));
    if (!pair.verdict.missed.empty()) {
        html += "<ul>\n";
        for (const std::string& missed : pair.verdict.missed)
            html += fmt::format("<li>{}</li>\n", escapedWhole(missed));
        html += "</ul>\n";
    }
    html += channelsHtml(pair);
    const std::string views = viewsHtml(report, pair);
    if (!views.empty()) html += fmt::format("<div class=\"views\">\n{}</div>\n", views);
    return html + fmt::format("<details><summary>All figures</summary>\n{}</details>\n</article>\n",
                              allFiguresHtml(pair.figures));
}

} // namespace tessera::validation
