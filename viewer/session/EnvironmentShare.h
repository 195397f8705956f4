#pragma once
#include <atomic>
#include <optional>

namespace tessera::viewer {

/// Progress of preparing an environment: first its map is computed, unless it comes from a file, then it is filtered.
struct EnvironmentShare {
    bool isFiltering = false; ///< else the map is being computed
    double done = 0.0;        ///< 0 to 1
    bool operator==(const EnvironmentShare&) const = default;
};

/// The latest progress, readable from other threads.
class EnvironmentProgress {
public:
    void begin() { latest_ = kNothing; }
    /// Raises the progress to the reported value. Reports of several threads may arrive out of order.
    void report(const EnvironmentShare& share) {
        const double value = share.done + (share.isFiltering ? kFiltering : 0.0);
        double known = latest_;
        while (value > known && !latest_.compare_exchange_weak(known, value)) {
        }
    }
    /// None if neither has begun.
    std::optional<EnvironmentShare> latest() const {
        const double value = latest_;
        if (value < 0.0) return std::nullopt;
        const bool isFiltering = value >= kFiltering;
        return EnvironmentShare{isFiltering, isFiltering ? value - kFiltering : value};
    }

private:
    static constexpr double kNothing = -1.0;
    static constexpr double kFiltering = 2.0; ///< added to filtering progress, to exceed all computation progress
    std::atomic<double> latest_ = kNothing;
};

} // namespace tessera::viewer
