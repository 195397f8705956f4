#pragma once
#include <atomic>
#include <optional>

namespace tessera::viewer {

/// How much of an environment a thread has filtered, as others read it.
inline constexpr double kNoShare = -1.0; ///< it filters none

inline std::optional<double> shareOf(const std::atomic<double>& share) {
    const double now = share;
    return now < 0.0 ? std::nullopt : std::optional(now);
}

/// Raises it to what one of several threads reports; the latest report need not tell of most.
inline void raiseShare(std::atomic<double>& share, double done) {
    double known = share;
    while (done > known && !share.compare_exchange_weak(known, done)) {
    }
}

} // namespace tessera::viewer
