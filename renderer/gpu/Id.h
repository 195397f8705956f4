#pragma once
#include <cstdint>
#include <utility>

namespace tessera::gpu {

/// A GL name with a single owner. A move construction leaves 0, which every glDelete* ignores; a move assignment swaps.
class Id {
public:
    Id() = default;
    explicit Id(std::uint32_t value) : value_(value) {}
    Id(Id&& other) noexcept : value_(std::exchange(other.value_, 0)) {}
    Id& operator=(Id&& other) noexcept {
        std::swap(value_, other.value_);
        return *this;
    }
    std::uint32_t value() const { return value_; }

private:
    std::uint32_t value_ = 0;
};

} // namespace tessera::gpu
