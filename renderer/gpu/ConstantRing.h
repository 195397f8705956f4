#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "renderer/gpu/Id.h"

namespace tessera::gpu {

/// Uniform blocks that change from draw to draw: each is copied behind the one before, in memory that the GPU reads
/// while the CPU writes on. Half of it is written again only when the GPU has read it.
class ConstantRing {
public:
    ConstantRing();
    ~ConstantRing();
    ConstantRing(const ConstantRing&) = delete;
    ConstantRing& operator=(const ConstantRing&) = delete;

    /// Binds a copy of the bytes, at most kMostBytes, as the uniform block at a slot. Throws std::logic_error for more.
    void bind(std::uint32_t slot, std::span<const std::byte> bytes);

    /// What OpenGL 4.5 guarantees that a uniform block may hold.
    static constexpr std::size_t kMostBytes = 16384;

private:
    void takeOtherHalf();

    Id buffer_;
    std::byte* memory_ = nullptr;
    std::size_t half_ = 0;
    std::size_t used_ = 0;          ///< bytes of that half
    std::array<void*, 2> fences_{}; ///< of each half, once it is left; GLsync
};

} // namespace tessera::gpu
