#pragma once
#include <cstdint>

namespace tessera::scenes::builtin {

/// The linear congruential generator of Press et al., "Numerical Recipes" (1992, section 7.1), in integers only, so
/// that every compiler and standard library makes the same scene.
class Random {
public:
    explicit Random(std::uint32_t seed) : state_(seed) {}

    /// The next state.
    std::uint32_t next() {
        state_ = state_ * 1664525u + 1013904223u;
        return state_;
    }
    /// 0 <= u < 1.
    double unit() { return next() / 4294967296.0; }
    /// low <= u < high.
    double between(double low, double high) { return low + (high - low) * unit(); }

private:
    std::uint32_t state_;
};

} // namespace tessera::scenes::builtin
