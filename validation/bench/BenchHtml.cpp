#include "validation/bench/BenchHtml.h"

#include <algorithm>
#include <set>
#include <span>

#include <fmt/format.h>

#include "base/Milliseconds.h"
#include "engine/Techniques.h"
#include "validation/bench/BenchJsonTerms.h"
#include "validation/bench/BenchTables.h"
#include "validation/bench/Pareto.h"
#include "validation/bench/Recommend.h"
#include "validation/bench/ScalingFit.h"
#include "validation/report/FigureHtml.h"
#include "validation/report/Html.h"

namespace tessera::validation {

namespace {

/// The meaning of mark shapes in plots: the method of a kind with several measured methods, else the G-buffer layout.
struct MarkKind {
    std::string_view name, words;
    const MethodKindInfo* kind = nullptr; ///< null: the layout

    std::string of(const PointKey& key) const {
        if (!kind) return key.layout;
        const std::optional<MethodKey>& method = key.method(kind->kind);
        return method ? method->name : "none";
    }
};

std::set<std::string> marksOf(const BenchRecord& record, const MarkKind& kind) {
    std::set<std::string> marks;
    for (const BenchGroup& group : record.groups)
        for (const BenchResult& result : group.results) marks.insert(kind.of(result.key));
    return marks;
}

MarkKind markKindOf(const BenchRecord& record) {
    const std::span<const MethodKindInfo> table = methodKindTable();
    for (auto info = table.rbegin(); info != table.rend(); ++info) {
        const MarkKind kind{info->markKind, info->markWords, &*info};
        if (marksOf(record, kind).size() > 1) return kind;
    }
    return {"layout", "Circles store every G-buffer channel in fp32, the other shapes pack it."};
}

Json plotPoint(const BenchResult& result, const MarkKind& kind, std::optional<bool> pareto, bool isBest) {
    const BenchError error = result.error.value_or(BenchError{});
    return {{"name", pointName(result.key)},
            {"technique", result.key.technique},
            {"mark", kind.of(result.key)},
            {"ms", result.times.cpuMs.median},
            {"p95", result.times.cpuMs.p95},
            {"relMse", orNull(error.relMse)},
            {"p99Rel", orNull(error.p99Rel)},
            {"toLowerBound", orNull(result.ratioToFloor)},
            {"toLitLowerBound", orNull(result.ratioToLitFloor)},
            {"front", pareto.value_or(false)},
            {"best", isBest}};
}

/// Legend text for the growth of a curve; empty if it has too few points for a fit.
std::string growthText(const ScalingCurve& curve) {
    if (!curve.fit) return "";
    return curve.fit->isTrend() ? fmt::format("{:.2f}", curve.fit->exponent) : "no trend";
}

/// The data that bench.js plots.
Json plotData(const BenchRecord& record) {
    const MarkKind kind = markKindOf(record);
    Json data = {
        {"techniques", Json::array()}, {"markKind", kind.name}, {"groups", Json::array()}, {"curves", Json::array()}};
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) data["techniques"].push_back(info.name);
    for (const BenchGroup& group : record.groups) {
        const std::vector<std::optional<bool>> pareto = paretoFront(group);
        const std::optional<Recommendation> choice = recommendFor(group);
        Json points = Json::array();
        for (std::size_t i = 0; i < group.results.size(); ++i)
            points.push_back(
                plotPoint(group.results[i], kind, pareto[i], choice && choice->recommends(group.results[i])));
        data["groups"].push_back({{"name", groupName(group)}, {"truth", group.truth}, {"points", points}});
    }
    for (const ScalingCurve& curve : scalingCurves(record.groups)) {
        data["curves"].push_back({{"scene", curve.scene},
                                  {"name", pointName(curve.key)},
                                  {"technique", curve.key.technique},
                                  {"mark", kind.of(curve.key)},
                                  {"quantity", curve.quantity},
                                  {"held", curve.held},
                                  {"x", curve.x},
                                  {"ms", curve.timeMs},
                                  {"growth", growthText(curve)}});
    }
    return data;
}

/// JSON for a script element, with '<' escaped so that it cannot end the element.
std::string scriptData(const Json& json) {
    std::string text;
    for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
        if (c == '<')
            text += "\\u003c";
        else
            text += c;
    }
    return fmt::format("<script type=\"application/json\" id=\"bench-data\">{}</script>\n", text);
}

std::string tileHtml(const std::string& label, const std::string& figure, const std::string& note) {
    return fmt::format("<div><dt>{}</dt><dd>{}<small>{}</small></dd></div>\n", label, figure, note);
}

std::string answerHtml(const BenchRecord& record, const BenchGroup& group) {
    const std::optional<Recommendation> choice = recommendFor(group);
    const std::string unfinished = unfinishedHtml(record);
    if (!choice) return unfinished + "<p class=\"choice\">Nothing is measured yet.</p>\n";
    const BenchResult& best = *choice->best;
    std::string how = best.key.tilePixels ? fmt::format("{} {}, ", best.key.culling, *best.key.tilePixels) : "";
    how += best.key.layout;
    if (best.key.isLitByCompute()) how += ", compute";
    for (const std::string& text : methodTexts(best.key.methods)) how += ", " + text;
    if (best.key.rangeTolerance > 0.0) how += fmt::format(", range {:g}", best.key.rangeTolerance);
    const bool isTaken = choice->recommends(best);
    if (!isTaken) how += fmt::format(": {}, measured times crown none", choice->caveat);
    std::string html = unfinished + "<dl class=\"answer\">\n" +
                       tileHtml(isTaken ? "Take" : "Ahead", escapedHtml(best.key.technique), escapedHtml(how));
    if (isTaken && choice->speedup) {
        const bool isSame = &best != choice->baseline && isAsFast(best.times.cpuMs, choice->baseline->times.cpuMs);
        const double speedup = isSame ? 1.0 : *choice->speedup;
        html +=
            tileHtml("Speed", fmt::format("{:.1f}&times;", speedup >= 1.0 ? speedup : 1.0 / speedup),
                     &best == choice->baseline ? (choice->asFast ? "forward, as fast as any" : "forward is the fastest")
                     : isSame                  ? "as fast as forward within the spread of the times"
                     : speedup >= 1.0          ? "faster than forward"
                                               : "slower than forward");
    }
    if (best.error)
        html += tileHtml("Error", figureHtml(best.error->relMse),
                         fmt::format("relMSE against {}", group.truth == "reference" ? "double precision" : "forward"));
    html += tileHtml("Time", millisecondsText(best.times.cpuMs.median) + "&#8239;ms",
                     !best.ratioToFloor ? "a frame"
                     : *best.ratioToFloor < 1.0
                         ? "a frame, below its lower bound: measure again"
                         : fmt::format("a frame, {:.1f}&times; the lower bound", *best.ratioToFloor));
    return html + "</dl>\n";
}

std::string paretoHtml(const BenchRecord& record, const BenchGroup& headline) {
    std::string choices;
    for (std::size_t i = 0; i < record.groups.size(); ++i)
        choices += fmt::format("<option value=\"{}\"{}>{}</option>", i,
                               &record.groups[i] == &headline ? " selected=\"selected\"" : "",
                               escapedHtml(groupName(record.groups[i])));
    const MarkKind kind = markKindOf(record);
    const std::string shapes = marksOf(record, kind).size() < 2 ? "" : fmt::format(" {}", kind.words);
    return fmt::format(
        "<section id=\"front\">\n<h2>Error against run time</h2>\n"
        "<p class=\"lede\">Every mark is one way to draw the same picture: faster to the left, closer to the truth "
        "below. The line joins those that no other beats in both; the ringed one is the one to take.{}</p>\n"
        "<p class=\"controls\"{}><label>Show <select id=\"front-group\">{}</select></label></p>\n"
        "<div class=\"plot\"><canvas id=\"front-plot\" role=\"img\" aria-label=\"relMSE against milliseconds a frame; "
        "the table of all points has the same figures\"></canvas></div>\n</section>\n",
        shapes, record.groups.size() < 2 ? " hidden=\"hidden\"" : "", choices);
}

std::string scalingHtml(const BenchRecord& record) {
    if (scalingCurves(record.groups).empty()) return "";
    return "<section id=\"scaling\">\n<h2>How time grows</h2>\n"
           "<p class=\"lede\">Both axes are logarithmic, so that a slope of 1 is time in proportion. The number behind "
           "a "
           "name is its slope, where a line explains at least nine tenths of the variance of the times (R&sup2; from "
           "0.9 "
           "on). Tap a name to hide its curve.</p>\n"
           "<p class=\"controls\"><label>Show <select id=\"scaling-curves\"></select></label></p>\n"
           "<div class=\"plot tall\"><canvas id=\"scaling-plot\" role=\"img\" aria-label=\"Milliseconds a frame "
           "against "
           "the chosen quantity\"></canvas></div>\n" +
           fitsHtml(record.groups) + "</section>\n";
}

std::string sharedHtml(const BenchPicture& picture) {
    if (picture.points.empty()) return "the truth";
    if (picture.points.size() < 2) return "";
    return fmt::format("and, bit for bit, {} other{}", picture.points.size() - 1, picture.points.size() > 2 ? "s" : "");
}

std::string picturesHtml(const BenchGroup& group, std::size_t number, const PictureBytes& bytes) {
    if (group.pictures.size() < 2) return "";
    std::string html = fmt::format("<article class=\"pair viewer\">\n<header><h3>{}</h3></header>\n"
                                   "<div class=\"stage-place\"></div>\n<div class=\"gallery\">\n",
                                   escapedHtml(groupName(group)));
    for (std::size_t i = 0; i < group.pictures.size(); ++i) {
        const BenchPicture& picture = group.pictures[i];
        html += fmt::format("<div>\n<figure>\n<img id=\"bench-{}-{}\" class=\"picture\" data-name=\"{}\" width=\"{}\" "
                            "height=\"{}\" alt=\"The scene as {} shows it\" src=\"{}\" />\n"
                            "<figcaption><strong>{}</strong> {}</figcaption>\n</figure>\n",
                            number, i, escapedHtml(picture.name), group.sizePixels.x, group.sizePixels.y,
                            escapedHtml(picture.name), pngDataUri(bytes(picture.file)), escapedHtml(picture.name),
                            sharedHtml(picture));
        if (picture.points.size() > 1) {
            std::string names;
            for (const std::string& name : picture.points) names += "<li>" + escapedHtml(name) + "</li>\n";
            html +=
                "<details><summary>All that show it</summary>\n<ul class=\"names\">\n" + names + "</ul>\n</details>\n";
        }
        if (!picture.heatMapFile.empty())
            html +=
                fmt::format("<figure>\n<img alt=\"Heat map of the relative error of {}\" src=\"{}\" />\n"
                            "<figcaption>Its relative error against {}, logarithmic: black agrees to fp32 rounding, "
                            "pale yellow is off by as much as it shows.</figcaption>\n</figure>\n",
                            escapedHtml(picture.name), pngDataUri(bytes(picture.heatMapFile)), group.truth);
        else if (!picture.points.empty())
            html += fmt::format("<p>It agrees with {} to fp32 rounding in every pixel.</p>\n", group.truth);
        html += "</div>\n";
    }
    return html + "</div>\n</article>\n";
}

std::string allPicturesHtml(const BenchRecord& record, const PictureBytes& bytes) {
    if (!bytes) return "";
    std::string html;
    for (std::size_t i = 0; i < record.groups.size(); ++i) html += picturesHtml(record.groups[i], i, bytes);
    if (html.empty()) return "";
    return "<section id=\"bench-pictures\">\n<h2>What they show</h2>\n" + html + "</section>\n";
}

std::string causesHtml(const BenchRecord& record) {
    std::string html;
    for (const BenchGroup& group : record.groups) {
        // One group per scene: the one that keeps images.
        if (!group.pictures.empty()) html += attributionHtml(group);
    }
    if (html.empty()) return "";
    return "<section id=\"causes\">\n<h2>Where the error comes from</h2>\n<p class=\"lede\">Each cause alone, all "
           "others absent; then the error of a point by all its causes, and its cross term: errors of one place add up "
           "or cancel. Bars are logarithmic, from 10<sup>&minus;12</sup> to 1.</p>\n" +
           html + "</section>\n";
}

std::string allPointsHtml(const BenchRecord& record, const BenchGroup& headline) {
    std::string html = "<section id=\"points\">\n<h2>All points</h2>\n";
    for (const BenchGroup& group : record.groups) {
        std::string note = fmt::format("errors against {}", group.truth);
        if (!group.whyTruth.empty()) note += ": " + group.whyTruth;
        html += fmt::format("<details{}><summary>{}; {}</summary>\n{}</details>\n",
                            &group == &headline ? " open=\"open\"" : "", escapedHtml(groupName(group)),
                            escapedHtml(note), pointsHtml(group));
    }
    if (!record.skipped.empty()) {
        html += "<details><summary>Skipped combinations</summary>\n<ul class=\"skipped\">\n";
        for (const SkippedPoint& skipped : record.skipped)
            html += fmt::format("<li>{}: {}</li>\n", escapedHtml(skipped.what), escapedHtml(skipped.why));
        html += "</ul>\n</details>\n";
    }
    return html + "</section>\n";
}

} // namespace

std::string unfinishedHtml(const BenchRecord& record) {
    if (record.isComplete) return "";
    return fmt::format("<p class=\"unfinished missed\" role=\"status\">{}</p>\n", escapedHtml(unfinishedText(record)));
}

ReportBench benchHtml(const BenchRecord& record, const BenchGroup& headline, const PictureBytes& pictureBytes) {
    return {answerHtml(record, headline), answersHtml(record) + paretoHtml(record, headline) + scalingHtml(record) +
                                              allPicturesHtml(record, pictureBytes) + causesHtml(record) +
                                              allPointsHtml(record, headline) + scriptData(plotData(record))};
}

} // namespace tessera::validation
