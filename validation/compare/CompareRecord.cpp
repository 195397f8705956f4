#include "validation/compare/CompareRecord.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "validation/figures/FigureText.h"

namespace tessera::validation {
namespace {

using Json = nlohmann::ordered_json;

Json toleranceJson(const Tolerance& tolerance) {
    return {{"maxRel", figureJson(tolerance.maxRel)}, {"bitEqual", figureJson(tolerance.bitEqual)},
            {"relMse", figureJson(tolerance.relMse)}, {"p999Rel", figureJson(tolerance.p999Rel)},
            {"bias", figureJson(tolerance.bias)},     {"biasNoises", tolerance.biasNoises}};
}

/// A reason for every figure that is null.
Json reasons(const Json& record, const ErrorFigures& figures) {
    Json why = Json::object();
    for (const auto& [name, value] : record.items()) {
        if (!value.is_null()) continue;
        if (name == "flip")
            why[name] = figures.flipReason;
        else if (name == "psnr")
            why[name] = figures.psnrReason;
        else if (figures.compared > 0)
            why[name] = "it is not finite: picture b is black or holds values beyond measure";
        else if (figures.covered > 0)
            why[name] = "no covered pixel is finite";
        else
            why[name] = "no pixel is covered";
    }
    return why;
}

Json shadowJson(const ShadowFigures& figures) {
    return {{"undecided", figures.undecided},
            {"noisyPixels", figures.noisyPixels},
            {"noise", figures.noise},
            {"mostNoise", figureJson(figures.mostNoise)},
            {"ofReference", figures.ofReference},
            {"bias", figures.bias},
            {"biasNoise", figures.biasNoise}};
}

bool isJudged(const Tolerance& tolerance) {
    return tolerance.maxRel || tolerance.bitEqual || tolerance.relMse || tolerance.p999Rel || tolerance.bias;
}

/// Whether the pair has a verdict: it has a tolerance, or it misses a requirement of all pairs.
bool isHeld(const ComparePair& pair) {
    return isJudged(pair.tolerance) || !pair.verdict.ok;
}

std::string notJudgedText(const ComparePair& pair) {
    return "not judged: " + (pair.tolerance.reason.empty() ? "no tolerance is set" : pair.tolerance.reason);
}

Json pairJson(const ComparePair& pair) {
    const ErrorFigures& figures = pair.figures;
    Json json = {{"a", pair.a},
                 {"b", pair.b},
                 {"maxAbs", figureJson(figures.maxAbs)},
                 {"maxRel", figureJson(figures.maxRel)},
                 {"rmse", figureJson(figures.rmse)},
                 {"relMse", figureJson(figures.relMse)},
                 {"p50Rel", figureJson(figures.p50Rel)},
                 {"p99Rel", figureJson(figures.p99Rel)},
                 {"p999Rel", figureJson(figures.p999Rel)},
                 {"bias", figureJson(figures.bias)},
                 {"biasNoise", figureJson(figures.biasNoise)},
                 {"bitEqual", figureJson(figures.bitEqual)},
                 {"flip", figureJson(figures.flip)},
                 {"psnr", figureJson(figures.psnr)},
                 {"nan", figures.bad.nan},
                 {"inf", figures.bad.infinite},
                 {"negative", figures.bad.negative},
                 {"excluded", figureJson(figures.excluded)},
                 {"litShare", figureJson(figures.litShare)},
                 {"litCovered", figureJson(figures.litCoveredShare())},
                 {"meanLuminance", figureJson(figures.meanLuminance)}};
    Json why = reasons(json, figures);
    if (!isHeld(pair)) why["ok"] = notJudgedText(pair);
    if (pair.culling.empty()) why["culling"] = "every light is visited, or the picture came from elsewhere";
    json["tolerance"] = toleranceJson(pair.tolerance);
    json["ok"] = isHeld(pair) ? Json(pair.verdict.ok) : Json(nullptr);
    json["missed"] = pair.verdict.missed;
    json["culling"] = pair.culling.empty() ? Json(nullptr) : Json(pair.culling);
    if (pair.shadows) json["shadows"] = shadowJson(*pair.shadows);
    json["why"] = why;
    if (pair.channels.empty()) return json;
    for (const ChannelShare& channel : pair.channels) {
        json["channels"].push_back({{"channel", channel.channel},
                                    {"relMseWithout", figureJson(channel.relMseWithout)},
                                    {"share", figureJson(channel.share)}});
    }
    return json;
}

Json rangeTruncationJson(const RangeTruncation& truncation) {
    const ErrorFigures& figures = truncation.figures;
    Json json = {{"tolerance", truncation.tolerance},
                 {"technique", truncation.technique},
                 {"bias", figureJson(figures.bias)},
                 {"relMse", figureJson(figures.relMse)},
                 {"p99Rel", figureJson(figures.p99Rel)}};
    const Json why = reasons(json, figures);
    json["why"] = why;
    return json;
}

Json lostJson(const LostGeometry& lost) {
    Json json = {{"what", lostName(lost.kind)}, {"instance", lost.instance ? Json(*lost.instance) : Json(nullptr)},
                 {"node", lost.node},           {"mesh", lost.mesh},
                 {"pixels", lost.pixels},       {"pixel", {lost.x, lost.y}}};
    json["why"] = lost.instance ? Json::object()
                                : Json{{"instance", "transparent surfaces of a pixel have one sum in the view ids, "
                                                    "which names none of them; look at the pixel"}};
    return json;
}

using Row = std::vector<std::string>;

/// "equal" for identical bytes, whose PSNR is infinite; a dash if the pair could not be compared.
std::string psnrText(const ErrorFigures& figures) {
    return figures.flip == 0.0 && !figures.psnr ? "equal" : decibelText(figures.psnr);
}

Row rowOf(const ComparePair& pair) {
    const ErrorFigures& figures = pair.figures;
    return {pair.a + " vs " + pair.b,
            shareText(figures.bitEqual),
            figureText(figures.maxRel),
            figureText(figures.p999Rel),
            figureText(figures.relMse),
            figureText(figures.bias),
            figureText(figures.flip.value_or(std::nan(""))),
            psnrText(figures),
            shareText(figures.litCoveredShare()),
            !pair.verdict.ok ? "MISSED"
            : isHeld(pair)   ? "ok"
                             : "not judged"};
}

} // namespace

bool CompareRecord::ok() const {
    return !pairs.empty() &&
           std::all_of(pairs.begin(), pairs.end(), [](const ComparePair& pair) { return pair.verdict.ok; });
}

ComparePair comparePair(std::string nameA, const Picture& a, std::string nameB, const Picture& b, Tolerance tolerance,
                        std::span<const std::uint8_t> excluded, const ShownPair& shown) {
    requireSameSize(a, nameA, b, nameB);
    ComparePair pair{std::move(nameA), std::move(nameB), errorFigures(a, b, excluded, shown), std::move(tolerance), {}};
    pair.verdict = checkTolerance(pair.figures, pair.tolerance);
    return pair;
}

void missLostGeometry(Verdict& verdict, std::span<const LostGeometry> lost) {
    if (lost.empty()) return;
    std::string missed = "geometry: " + lostText(lost.front());
    if (lost.size() > 1) missed += fmt::format("; and {} more", lost.size() - 1);
    verdict.missed.push_back(std::move(missed));
    verdict.ok = false;
}

std::string compareJson(const CompareRecord& record) {
    Json pairs = Json::array();
    for (const ComparePair& pair : record.pairs) pairs.push_back(pairJson(pair));
    Json leftOut = Json::array();
    for (const LeftOutTechnique& item : record.leftOut)
        leftOut.push_back({{"technique", item.technique}, {"why", item.why}});
    Json json = {{"schema", 1},
                 {"scene", record.scene},
                 {"size", {record.width, record.height}},
                 {"samples", record.samples},
                 {"renderer", record.renderer},
                 {"pairs", pairs},
                 {"left_out", leftOut}};
    if (record.excludesPixels) {
        json["lost"] = Json::array();
        for (const LostGeometry& lost : record.lost) json["lost"].push_back(lostJson(lost));
    }
    if (record.diffusedLight)
        json["spreadLight"] = {{"pixels", record.diffusedLight->pixels},
                               {"integral", record.diffusedLight->integral},
                               {"facingAway", record.diffusedLight->facingAway}};
    if (record.rangeTruncation) json["rangeTruncation"] = rangeTruncationJson(*record.rangeTruncation);
    // File names need not be UTF-8: replaces invalid bytes, so that the record is written all the same.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string compareTable(const CompareRecord& record) {
    std::vector<Row> rows = {
        {"pair", "bit-equal", "max rel", "p99.9 rel", "relMSE", "bias", "FLIP", "PSNR", "lit", "verdict"}};
    for (const ComparePair& pair : record.pairs) rows.push_back(rowOf(pair));
    const std::string samples = record.samples == 1 ? "" : fmt::format(", {} samples", record.samples);
    std::string text =
        fmt::format("{}  {}x{}{}  {}\n", record.scene, record.width, record.height, samples, record.renderer) +
        textTable(rows, 1);
    if (record.excludesPixels && !record.pairs.empty())
        text += fmt::format("excluded: {} of the covered pixels, where rounding moves an edge\n",
                            shareText(record.pairs.front().figures.excluded));
    for (const ComparePair& pair : record.pairs)
        if (pair.shadows) text += fmt::format("shadows: {}: {}\n", pair.a, shadowText(*pair.shadows));
    if (record.diffusedLight)
        text += fmt::format(
            "diffused light: in {} pixels; the profile's integral over the surface, by which the reference "
            "divides, is {:.4g} on average; {} of it is where the surface faces away, which light does "
            "not reach along the surface\n",
            record.diffusedLight->pixels, record.diffusedLight->integral, shareText(record.diffusedLight->facingAway));
    for (const LostGeometry& lost : record.lost) text += "geometry: " + lostText(lost) + "\n";
    for (const ComparePair& pair : record.pairs)
        if (!isHeld(pair) && !pair.tolerance.reason.empty())
            text += fmt::format("not judged: {} vs {}: {}\n", pair.a, pair.b, pair.tolerance.reason);
    for (const ComparePair& pair : record.pairs)
        for (const std::string& missed : pair.verdict.missed)
            text += fmt::format("missed: {} vs {}: {}\n", pair.a, pair.b, missed);
    for (const ComparePair& pair : record.pairs) {
        for (const ChannelShare& channel : pair.channels) {
            text += fmt::format("{}: channel {} adds {} to relMSE ({} without it)\n", pair.a, channel.channel,
                                figureText(channel.share), figureText(channel.relMseWithout));
        }
    }
    for (const LeftOutTechnique& item : record.leftOut)
        text += fmt::format("left out: {}: {}\n", item.technique, item.why);
    if (record.rangeTruncation) {
        const RangeTruncation& truncation = *record.rangeTruncation;
        text += fmt::format("dropped by the range tolerance {:g}: {} ({} against itself without it)\n",
                            truncation.tolerance, droppedText(truncation.figures), truncation.technique);
    }
    return text;
}

std::string droppedText(const ErrorFigures& figures) {
    return fmt::format("bias {}, relMSE {}, p99 rel {}", figureText(figures.bias), figureText(figures.relMse),
                       figureText(figures.p99Rel));
}

} // namespace tessera::validation
