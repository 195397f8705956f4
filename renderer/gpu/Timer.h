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

/// Measures spans of GPU work by a ring of timestamp queries, so that reading never waits for the GPU. Meaningless on
/// software rasterisers (Capabilities::isSoftware), which defer the work.
class GpuTimer {
public:
    explicit GpuTimer(const std::string& label);
    ~GpuTimer();
    GpuTimer(GpuTimer&&) noexcept = default;
    GpuTimer& operator=(GpuTimer&&) noexcept = default;

    /// Calls of begin() and end() alternate. A span goes unmeasured while every slot of the ring is pending.
    void begin();
    void end();
    /// Time of the newest span that the GPU has finished, in milliseconds; none before the first. Never waits.
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
