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
    void begin() { told_ = kNothing; }
    /// Raises the progress to the reported value. Reports of several threads may arrive out of order.
    void tell(const EnvironmentShare& share) {
        const double told = share.done + (share.isFiltering ? kFiltering : 0.0);
        double known = told_;
        while (told > known && !told_.compare_exchange_weak(known, told)) {
        }
    }
    /// None if neither has begun.
    std::optional<EnvironmentShare> latest() const {
        const double told = told_;
        if (told < 0.0) return std::nullopt;
        const bool isFiltering = told >= kFiltering;
        return EnvironmentShare{isFiltering, isFiltering ? told - kFiltering : told};
    }

private:
    static constexpr double kNothing = -1.0;
    static constexpr double kFiltering = 2.0; ///< added to filtering progress, to exceed all computation progress
    std::atomic<double> told_ = kNothing;
};

} // namespace tessera::viewer
