#pragma once
#include <memory>
#include <string>

#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/TexelBuffer.h"

namespace tessera::frame {

/// A buffer of whole texels that grows to what a frame needs, by a quarter more so that it seldom grows, and never
/// shrinks; its contents do not outlive growing.
class GrowingTexelBuffer {
public:
    GrowingTexelBuffer(std::string label, graph::Format format);
    /// Throws InputError with the remedy when `texels` are more than the driver can read or hold.
    void require(std::size_t texels);
    std::size_t used() const { return used_; } ///< texels, as last required
    std::size_t texelBytes() const;
    const gpu::Buffer& buffer() const { return buffer_; }
    const gpu::TexelBuffer& texels() const { return *texels_; }

private:
    std::string label_;
    graph::Format format_;
    std::size_t used_ = 0;
    gpu::Buffer buffer_;
    std::unique_ptr<gpu::TexelBuffer> texels_;
};

} // namespace tessera::frame
