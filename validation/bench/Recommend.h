#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "validation/bench/BenchResult.h"

namespace tessera::validation {

/// Error up to which an image counts as correct: relMse 1e-4, an RMS error of 1 % per pixel. The packed layout promises
/// this.
inline constexpr double kAcceptableRelMse = 1e-4;

/// Which point of a group to take.
struct Recommendation {
    /// The fastest with an acceptable error, or a more exact one that is as fast within the spread of the times; if
    /// none is acceptable, the most exact.
    const BenchResult* best = nullptr;
    const BenchResult* asFast = nullptr; ///< the fastest, if best is more exact and as fast within the spread
    /// The fastest of the most exact ones, if that is another point.
    const BenchResult* exact = nullptr;
    /// Forward, if it was measured: with the smallest range tolerance, and then the smallest error.
    const BenchResult* baseline = nullptr;
    bool isAcceptable = false;
    std::string_view caveat;            ///< why nothing is recommended; empty: best is
    std::optional<double> speedup;      ///< of best over forward
    std::optional<double> exactSpeedup; ///< of exact over forward

    bool recommends(const BenchResult& result) const { return caveat.empty() && best == &result; }
};

/// Whether two times are indistinguishable: each median lies within the other's spread, the distance from median to
/// p95.
bool isAsFast(const TimeSpread& a, const TimeSpread& b);

/// Unset for a group without results. Holds pointers into the group.
std::optional<Recommendation> recommendFor(const BenchGroup& group);

/// "3.1x faster than forward", "as fast as forward", "1.4x slower than forward".
std::string speedText(double speedup);

/// The recommendation in plain words, one or two sentences per group: the point to take on this machine, its speed
/// relative to forward, and its error.
std::string recommendationText(const BenchGroup& group);
std::string recommendationText(std::span<const BenchGroup> groups);

} // namespace tessera::validation
