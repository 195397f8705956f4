#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include "renderer/gpu/Buffer.h"
#include "renderer/graph/Format.h"

namespace tessera::gpu {

/// A buffer texture (samplerBuffer), the fastest way to read lights on most rasterisers. The buffer must outlive it.
/// Only whole texels within the driver's limit are readable.
class TexelBuffer {
public:
    /// Throws std::runtime_error when the format is depth, sRGB or signed-normalised, which buffer textures lack.
    TexelBuffer(std::string label, graph::Format format, const Buffer& buffer);
    ~TexelBuffer();
    TexelBuffer(TexelBuffer&&) noexcept = default;
    TexelBuffer& operator=(TexelBuffer&&) noexcept = default;

    std::size_t texels() const { return texels_; }
    std::uint32_t id() const { return id_.value(); }

private:
    std::size_t texels_ = 0;
    Id id_;
};

} // namespace tessera::gpu
