#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "validation/bench/BenchResult.h"

namespace tessera::validation {

/// An error below which a picture is taken for the truth: relMse 1e-4, 1 % of a pixel in the mean square. It is what
/// the packed layout promises.
inline constexpr double kAcceptableRelMse = 1e-4;

/// Which point of a group to take.
struct Recommendation {
    /// Of those whose error is acceptable the fastest, or a more exact one that takes as long within the spread of the
    /// times; without any such the most exact.
    const BenchResult* best = nullptr;
    const BenchResult* asFast =
        nullptr; ///< the fastest, where the times do not tell it from best and best is more exact
    /// The fastest that is as exact as any, where that is another point.
    const BenchResult* exact = nullptr;
    /// Forward, where it was measured: with the smallest range tolerance, and with the shadows of the smallest error.
    const BenchResult* baseline = nullptr;
    bool isAcceptable = false;
    std::string_view caveat;            ///< why nothing is recommended; empty: best is
    std::optional<double> speedup;      ///< of best over forward
    std::optional<double> exactSpeedup; ///< of exact over forward

    bool takes(const BenchResult& result) const { return caveat.empty() && best == &result; }
};

/// Whether two times are indistinguishable: each median lies within the other's spread, the distance from median to
/// p95.
bool isAsFast(const TimeSpread& a, const TimeSpread& b);

/// None for a group without results. Pointers into the group.
std::optional<Recommendation> recommendFor(const BenchGroup& group);

/// "3.1x faster than forward", "as fast as forward", "1.4x slower than forward".
std::string speedText(double speedup);

/// The recommendation in plain words, one sentence or two per group: which of the points to take on this machine, how
/// much faster it is than forward, at what error.
std::string recommendationText(const BenchGroup& group);
std::string recommendationText(std::span<const BenchGroup> groups);

} // namespace tessera::validation
