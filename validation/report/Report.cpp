#include "validation/report/Report.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "chartAssets.gen.h"
#include "reportAssets.gen.h"
#include "validation/report/Html.h"
#include "validation/report/ReportPairs.h"

namespace tessera::validation {
namespace {

constexpr const char* kFiguresToRead =
    "<dt>Where they are taken</dt>\n<dd>On linear radiance in 32 bit floats, before any display transform, over the "
    "pixels where either picture shows geometry; in each pair the second picture is the truth.</dd>\n"
    "<dt>rel</dt>\n<dd>Error of a channel over its true value, but over no less than a thousandth of the picture's "
    "typical luminance; a pixel counts with its worst channel. p99.9 is what 99.9&nbsp;% of the pixels stay "
    "within.</dd>\n"
    "<dt>relMSE</dt>\n<dd>Mean of squared error over squared true value plus a hundredth of the squared typical "
    "luminance.</dd>\n"
    "<dt>FLIP</dt>\n<dd>How different two pictures look when one flips between them, mean over the pixels: 0 is the "
    "same, 1 could not differ more (Andersson et al. 2020).</dd>\n"
    "<dt>Bias</dt>\n<dd>How much brighter the picture is on average, as a share of the truth.</dd>\n";
constexpr const char* kPairsToRead =
    "<dt>Equal bits</dt>\n<dd>Share of those pixels whose red, green and blue are the same to the last bit.</dd>\n"
    "<dt>What never holds</dt>\n<dd>A pair with a black picture, with under a tenth of the pixels lit, or with any "
    "NaN, infinite or negative pixel.</dd>\n";
constexpr const char* kBenchToRead =
    "<dt>ms a frame</dt>\n<dd>Wall time from a frame's first call until everything is drawn, culling and uploads "
    "included: the median of the timed frames, and what 95&nbsp;% of them stay within. All points of a group take "
    "turns, so that a machine that changes its pace treats them alike.</dd>\n"
    "<dt>To lower bound</dt>\n<dd>Time over the lower bound, which the frame cannot go below and which is measured in "
    "the same run: the geometry in a constant colour, and each light only at the pixels that it reaches; lit, only "
    "where it also shines on the front of the surface.</dd>\n"
    "<dt>Visited</dt>\n<dd>Lights that a pixel evaluates, on average.</dd>\n"
    "<dt>The front</dt>\n<dd>Points that no other beats in both time and relMSE.</dd>\n";

std::string_view asset(std::string_view path) {
    for (const EmbeddedFile& file : reportAssets())
        if (file.path == path) return file.text;
    throw std::logic_error(fmt::format("{} is not embedded", path)); // the build embeds every file that is named here
}

std::string verdictHtml(const CompareRecord& record) {
    const std::size_t all = record.pairs.size();
    const std::size_t missed = std::size_t(std::count_if(record.pairs.begin(), record.pairs.end(),
                                                         [](const ComparePair& pair) { return !pair.verdict.ok; }));
    std::string text;
    if (all == 0)
        text = "Nothing was compared.";
    else if (missed > 0)
        text = fmt::format("&#10007; {} of {} comparisons missed a tolerance or lost geometry; each one below lists "
                           "what it missed.",
                           missed, all);
    else
        text = all == 1 ? "&#10003; The comparison holds." : fmt::format("&#10003; All {} comparisons hold.", all);
    return fmt::format("<p class=\"verdict {}\">{}</p>\n", record.ok() ? "ok" : "missed", text);
}

std::string factHtml(const std::string& label, const std::string& value) {
    return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escapedHtml(label), escapedHtml(value));
}

std::string pictureHtml(const Report& report, const ReportPicture& picture) {
    return fmt::format("<figure>\n<img id=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\" src=\"{}\" />\n"
                       "<figcaption><strong>{}</strong> {}</figcaption>\n</figure>\n",
                       pictureId(report, picture.name), picture.image.width, picture.image.height,
                       escapedHtml("The scene as rendered by " + picture.name), pngDataUri(picture.image.bytes),
                       escapedHtml(picture.name), escapedHtml(picture.caption));
}

/// The head of the page, with its subject and the first image; the other images follow below.
std::string mastheadHtml(const Report& report) {
    const CompareRecord& record = report.record;
    std::string html =
        fmt::format("<header class=\"masthead\">\n<p class=\"kicker\">Tessera &middot; {}</p>\n<h1>{}</h1>\n",
                    report.bench ? "error against run time" : "comparison", escapedHtml(report.title));
    const bool compares = !record.pairs.empty() || !report.bench;
    if (compares) html += verdictHtml(record);
    if (report.bench) html += report.bench->answer;
    html += "<div class=\"opening\">\n<div>\n";
    if (!report.choice.empty()) html += fmt::format("<p class=\"choice\">{}</p>\n", escapedWhole(report.choice));
    html += "<dl class=\"facts\">\n";
    if (compares)
        html += factHtml("Scene", record.scene) + factHtml(report.bench ? "Compared at" : "Size",
                                                           fmt::format("{} \u00d7 {}", record.width, record.height));
    for (const ReportFact& fact : report.facts) html += factHtml(fact.label, fact.value);
    html += factHtml("Renderer", record.renderer) + "</dl>\n</div>\n";
    if (!report.pictures.empty()) html += pictureHtml(report, report.pictures.front());
    return html + "</div>\n</header>\n";
}

std::string pairsHtml(const Report& report) {
    if (report.record.pairs.empty()) return "";
    std::string html = "<section id=\"figures\">\n<h2>The comparisons</h2>\n" + pairTableHtml(report.record) +
                       droppedHtml(report.record) + "</section>\n<section id=\"pairs\">\n<h2>Side by side</h2>\n";
    for (std::size_t i = 0; i < report.record.pairs.size(); ++i) html += pairHtml(report, i);
    return html + "</section>\n";
}

std::string galleryHtml(const Report& report) {
    if (report.pictures.size() < 2) return "";
    std::string html = "<section id=\"pictures\">\n<h2>The other pictures</h2>\n<div class=\"gallery\">\n";
    for (std::size_t i = 1; i < report.pictures.size(); ++i) html += pictureHtml(report, report.pictures[i]);
    return html + "</div>\n</section>\n";
}

std::string plansHtml(const Report& report) {
    if (report.plans.empty()) return "";
    std::string html = "<section id=\"plans\">\n<h2>What ran, and what was left out</h2>\n";
    for (const ReportPlan& plan : report.plans)
        html += fmt::format("<details><summary>{}</summary>\n<pre>{}</pre>\n</details>\n", escapedHtml(plan.technique),
                            escapedHtml(plan.text));
    return html + "</section>\n";
}

std::string commandsHtml(const Report& report) {
    if (report.commands.empty()) return "";
    std::string html = "<section id=\"commands\">\n<h2>Do it again</h2>\n";
    for (const std::string& command : report.commands)
        html += fmt::format("<div class=\"command\"><pre><code>{}</code></pre></div>\n", escapedWhole(command));
    return html + "</section>\n";
}

std::string readingHtml(const Report& report) {
    return fmt::format(
        "<section id=\"reading\">\n<h2>How to read the figures</h2>\n<dl class=\"reading\">\n{}{}{}</dl>\n"
        "</section>\n",
        kFiguresToRead, report.bench && report.record.pairs.empty() ? "" : kPairsToRead,
        report.bench ? kBenchToRead : "");
}

std::string scriptHtml(std::string_view script) {
    return fmt::format("<script>\n{}</script>\n", script);
}

} // namespace

std::string reportHtml(const Report& report) {
    // The empty icon keeps browsers from requesting one from a server.
    return fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\" />\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n"
                       "<meta name=\"generator\" content=\"tessera\" />\n<link rel=\"icon\" href=\"data:,\" />\n"
                       "<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n",
                       escapedHtml(report.title), asset("report.css")) +
           mastheadHtml(report) + "<main>\n" + (report.bench ? report.bench->sections : "") + pairsHtml(report) +
           galleryHtml(report) + plansHtml(report) + commandsHtml(report) + readingHtml(report) + "</main>\n" +
           scriptHtml(asset("report.js")) +
           (report.bench ? scriptHtml(chart::chartAssets()[0].text) + scriptHtml(asset("bench.js")) : "") +
           "</body>\n</html>\n";
}

} // namespace tessera::validation
