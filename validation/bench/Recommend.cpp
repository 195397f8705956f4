#include "validation/bench/Recommend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/Milliseconds.h"
#include "validation/bench/Pareto.h"
#include "validation/figures/FigureText.h"

namespace tessera::validation {

namespace {

/// Ratio of errors up to which two images are equally exact: rounding alone differs by that much between GPUs.
constexpr double kAsExact = 2.0;
/// Ratio of times up to which two are called the same: medians of 20 frames repeat to within a few percent.
constexpr double kSameSpeed = 1.05;

constexpr std::string_view kBusy = "the machine was busy", kNothingToCull = "nothing to cull";

double timeOf(const BenchResult& result) {
    return result.times.cpuMs.median;
}

/// Whether single frames took far longer than most, as on a busy machine.
bool isDisturbed(const BenchResult& result) {
    constexpr double kSteady = 2.0; // p95 over median; below 1.3 on an otherwise idle machine
    return result.times.cpuMs.p95 > kSteady * timeOf(result);
}

template <typename Condition>
const BenchResult* fastest(const BenchGroup& group, Condition&& holds) {
    const BenchResult* best = nullptr;
    for (const BenchResult& result : group.results) {
        if (holds(result) && (!best || timeOf(result) < timeOf(*best))) best = &result;
    }
    return best;
}

/// The forward result with the smallest range tolerance; among several methods, the one with the smallest error.
const BenchResult* forwardOf(const BenchGroup& group) {
    const BenchResult* found = nullptr;
    for (const BenchResult& result : group.results) {
        if (result.key.technique != "forward") continue;
        const auto rank = [](const BenchResult& one) {
            return std::pair(one.key.rangeTolerance, relMseOf(one).value_or(std::numeric_limits<double>::infinity()));
        };
        if (!found || rank(result) < rank(*found)) found = &result;
    }
    return found;
}

bool isAcceptable(const BenchResult& result) {
    const std::optional<double> relMse = relMseOf(result);
    return relMse && *relMse <= kAcceptableRelMse;
}

/// The fastest of the most exact acceptable results whose times are indistinguishable from `fast`. Results faster than
/// one of these count too, however small the spread of their times.
const BenchResult* mostExactAsFast(const BenchGroup& group, const BenchResult& fast) {
    double slowestMs = timeOf(fast);
    for (const BenchResult& result : group.results)
        if (isAcceptable(result) && isAsFast(result.times.cpuMs, fast.times.cpuMs))
            slowestMs = std::max(slowestMs, timeOf(result));
    const auto isCandidate = [&](const BenchResult& result) {
        return isAcceptable(result) && timeOf(result) <= slowestMs;
    };
    double least = *relMseOf(fast);
    for (const BenchResult& result : group.results)
        if (isCandidate(result)) least = std::min(least, *relMseOf(result));
    return fastest(
        group, [&](const BenchResult& result) { return isCandidate(result) && *relMseOf(result) <= kAsExact * least; });
}

} // namespace

bool isAsFast(const TimeSpread& a, const TimeSpread& b) {
    return std::abs(a.median - b.median) <= std::min(a.p95 - a.median, b.p95 - b.median);
}

std::optional<Recommendation> recommendFor(const BenchGroup& group) {
    if (group.results.empty()) return {};
    std::optional<double> least;
    for (const BenchResult& result : group.results) {
        const std::optional<double> relMse = relMseOf(result);
        if (relMse && (!least || *relMse < *least)) least = relMse;
    }
    Recommendation choice;
    choice.baseline = forwardOf(group);
    const auto isExact = [&](const BenchResult& result) {
        return least && relMseOf(result) && *relMseOf(result) <= kAsExact * *least;
    };
    choice.best = fastest(group, isAcceptable);
    choice.isAcceptable = choice.best != nullptr;
    if (const BenchResult* fast = choice.best) {
        choice.best = mostExactAsFast(group, *fast);
        if (choice.best != fast) choice.asFast = fast;
    }
    if (!choice.best) choice.best = fastest(group, isExact);
    if (!choice.best) choice.best = fastest(group, [](const BenchResult&) { return true; }); // no errors are known
    const BenchResult* exact = fastest(group, isExact);
    if (exact != choice.best) choice.exact = exact;
    if (isDisturbed(*choice.best) || (choice.baseline && isDisturbed(*choice.baseline)))
        choice.caveat = kBusy;
    else if (group.lights == 0)
        choice.caveat = kNothingToCull;
    if (choice.baseline) {
        choice.speedup = timeOf(*choice.baseline) / timeOf(*choice.best);
        if (choice.exact) choice.exactSpeedup = timeOf(*choice.baseline) / timeOf(*choice.exact);
    }
    return choice;
}

std::string speedText(double speedup) {
    if (speedup >= kSameSpeed) return fmt::format("{:.1f}x faster than forward", speedup);
    if (speedup <= 1.0 / kSameSpeed) return fmt::format("{:.1f}x slower than forward", 1.0 / speedup);
    return "as fast as forward";
}

namespace {

/// Speed relative to forward, whose methods are named where they differ.
std::string againstForward(const BenchResult& result, const BenchResult& baseline) {
    std::string how;
    const auto add = [&how](const std::string& text) { how += (how.empty() ? " (" : ", ") + text; };
    for (const MethodKindInfo& info : methodKindTable())
        if (const auto& method = baseline.key.method(info.kind); method && method != result.key.method(info.kind))
            add(methodText(info.kind, *method));
    if (!how.empty()) how += ")";
    if (isAsFast(result.times.cpuMs, baseline.times.cpuMs))
        return fmt::format("as fast as forward{} within the spread of the times", how);
    return speedText(timeOf(baseline) / timeOf(result)) + how;
}

} // namespace

std::string recommendationText(const BenchGroup& group) {
    const std::optional<Recommendation> choice = recommendFor(group);
    if (!choice) return "";
    const BenchResult& best = *choice->best;
    std::string text;
    if (choice->caveat == kBusy)
        text =
            fmt::format("The machine was too busy to decide which technique is best for {}: some frames took more than "
                        "twice the median. Measure again. So far {} leads: ",
                        groupName(group), pointName(best.key));
    else if (choice->caveat == kNothingToCull)
        text = fmt::format("In {} there is nothing to cull. Ahead is {}: ", groupName(group), pointName(best.key));
    else
        text = fmt::format("For {} take {}: ", groupName(group), pointName(best.key));
    if (choice->baseline == &best)
        text += choice->asFast ? "as fast as any" : "the fastest here";
    else if (choice->speedup)
        text += againstForward(best, *choice->baseline);
    else
        text += choice->asFast ? "as fast as any of those measured" : "the fastest of those measured";
    if (relMseOf(best)) text += fmt::format(" at relMSE {}", figureText(*relMseOf(best)));
    text += fmt::format(", {} ms a frame", millisecondsText(timeOf(best)));
    if (best.ratioToFloor) text += fmt::format(", {:.1f} times the lower bound", *best.ratioToFloor);
    text += ".";
    if (!choice->isAcceptable && relMseOf(best))
        text += fmt::format(" Nothing here stays below relMSE {:g}; this is the most exact.", kAcceptableRelMse);
    if (choice->asFast)
        text += fmt::format(" {} takes as long within the spread of the times, {} ms, at the larger relMSE {}.",
                            pointName(choice->asFast->key), millisecondsText(timeOf(*choice->asFast)),
                            figureText(*relMseOf(*choice->asFast)));
    if (choice->exact) {
        text += fmt::format(" The most exact is {}", pointName(choice->exact->key));
        if (choice->exact != choice->baseline && choice->exactSpeedup)
            text += fmt::format(": {}", againstForward(*choice->exact, *choice->baseline));
        text += fmt::format(" at relMSE {}.", figureText(*relMseOf(*choice->exact)));
    }
    if (best.ratioToFloor && *best.ratioToFloor < 1.0)
        text += " No frame can be faster than its lower bound: something disturbed the times; measure again.";
    return text;
}

std::string recommendationText(std::span<const BenchGroup> groups) {
    std::string text;
    for (const BenchGroup& group : groups) {
        const std::string one = recommendationText(group);
        if (!one.empty()) text += (text.empty() ? "" : " ") + one;
    }
    return text;
}

} // namespace tessera::validation
