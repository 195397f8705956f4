#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "renderer/gpu/Id.h"

namespace tessera::gpu {

/// Milliseconds of a monotonic clock since construction or restart.
class CpuTimer {
public:
    void restart() { start_ = Clock::now(); }
    double elapsedMs() const { return std::chrono::duration<double, std::milli>(Clock::now() - start_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// Times stretches of GPU work by time stamps in a ring, so that reading never waits for the GPU. On software
/// rasterisers the figures mean nothing (the work is deferred); Capabilities::isSoftware tells.
class GpuTimer {
public:
    explicit GpuTimer(const std::string& label);
    ~GpuTimer();
    GpuTimer(GpuTimer&&) noexcept = default;
    GpuTimer& operator=(GpuTimer&&) noexcept = default;

    /// begin() and end() in turn. When every slot of the ring is still under way the stretch goes unmeasured.
    void begin();
    void end();
    /// The newest stretch that the GPU has finished, in milliseconds; none before the first one has. Never waits.
    std::optional<double> latestMs();

private:
    static constexpr std::size_t kSlots = 4; ///< drivers queue up to three frames; one more is being recorded
    struct Slot {
        Id begin, end;
        bool pending = false;
    };
    std::array<Slot, kSlots> slots_;
    std::size_t next_ = 0;   ///< slot of the next begin()
    std::size_t oldest_ = 0; ///< first slot that may be pending
    bool open_ = false;
    bool measuring_ = false;
    std::optional<double> latestMs_;
};

} // namespace tessera::gpu
