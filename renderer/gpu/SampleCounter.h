#pragma once
#include <cstdint>

#include "renderer/gpu/Id.h"

namespace tessera::gpu {

/// Counts the samples that pass the depth test between begin() and end().
class SampleCounter {
public:
    SampleCounter();
    ~SampleCounter();
    SampleCounter(SampleCounter&&) noexcept = default;
    SampleCounter& operator=(SampleCounter&&) noexcept = default;

    void begin();
    void end();
    /// Result of the latest begin() and end(); waits for the GPU.
    std::uint64_t samples() const;

private:
    Id id_;
};

} // namespace tessera::gpu
