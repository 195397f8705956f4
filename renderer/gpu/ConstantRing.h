#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "renderer/gpu/Id.h"

namespace tessera::gpu {

/// A ring buffer for uniform blocks that change per draw, in persistently mapped memory. A half is reused only after
/// the GPU has read it.
class ConstantRing {
public:
    ConstantRing();
    ~ConstantRing();
    ConstantRing(const ConstantRing&) = delete;
    ConstantRing& operator=(const ConstantRing&) = delete;

    /// Binds a copy of 1 to kMostBytes bytes as the uniform block at a slot. Throws std::logic_error for other sizes.
    void bind(std::uint32_t slot, std::span<const std::byte> bytes);

    /// Uniform block size that OpenGL 4.5 guarantees.
    static constexpr std::size_t kMostBytes = 16384;

private:
    void takeOtherHalf();

    Id buffer_;
    std::byte* memory_ = nullptr;
    std::size_t half_ = 0;
    std::size_t used_ = 0;          ///< bytes of the current half
    std::array<void*, 2> fences_{}; ///< GLsync of each half, set when the ring leaves it
};

} // namespace tessera::gpu
