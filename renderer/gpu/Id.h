#pragma once
#include <cstdint>
#include <utility>

namespace tessera::gpu {

/// A GL name owned by one object: moving leaves 0 behind, which every glDelete* ignores.
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
