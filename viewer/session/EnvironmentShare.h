#pragma once
#include <atomic>
#include <optional>

namespace tessera::viewer {

/// How far a thread is with an environment: first its map is computed, unless it is a file's, then that is filtered.
struct EnvironmentShare {
    bool isFiltering = false; ///< else its map is computed
    double done = 0.0;        ///< 0 to 1
    bool operator==(const EnvironmentShare&) const = default;
};

/// The latest, as other threads read it.
class EnvironmentProgress {
public:
    void begin() { told_ = kNothing; }
    /// Raises it to what one of several threads tells; what is told last need not be the most.
    void tell(const EnvironmentShare& share) {
        const double told = share.done + (share.isFiltering ? kFiltering : 0.0);
        double known = told_;
        while (told > known && !told_.compare_exchange_weak(known, told)) {
        }
    }
    /// None where neither is done.
    std::optional<EnvironmentShare> latest() const {
        const double told = told_;
        if (told < 0.0) return std::nullopt;
        const bool isFiltering = told >= kFiltering;
        return EnvironmentShare{isFiltering, isFiltering ? told - kFiltering : told};
    }

private:
    static constexpr double kNothing = -1.0;
    static constexpr double kFiltering = 2.0; ///< added to shares of filtering, above all of computing
    std::atomic<double> told_ = kNothing;
};

} // namespace tessera::viewer
