#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <ranges>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "renderer/gpu/Id.h"
#include "renderer/graph/Format.h"

namespace tessera::gpu {

class TexelBuffer;

/// Static: written seldom. Dynamic: written every frame. Readback: lives where the CPU reads it cheaply.
enum class BufferUse { Static, Dynamic, Readback };

/// A GPU buffer of fixed size, zero-initialised. Size 0 is rounded up to 16 bytes, so that empty lists can be bound.
class Buffer {
public:
    /// Throws std::runtime_error naming label and size when memory runs out.
    Buffer(std::string label, std::size_t bytes, BufferUse use = BufferUse::Static);
    /// Makes a buffer that holds a copy of `values`.
    template <std::ranges::contiguous_range Range>
    static Buffer of(std::string label, const Range& values, BufferUse use = BufferUse::Static) {
        static_assert(std::is_trivially_copyable_v<std::ranges::range_value_t<Range>>);
        return Buffer(std::move(label), std::as_bytes(std::span(std::ranges::data(values), std::ranges::size(values))),
                      use);
    }
    ~Buffer();
    Buffer(Buffer&&) noexcept;
    Buffer& operator=(Buffer&&) noexcept;

    /// Writes a vector, span or array of plain values at `offsetBytes`; must fit (asserted).
    template <std::ranges::contiguous_range Range>
    void upload(const Range& values, std::size_t offsetBytes = 0) const {
        static_assert(std::is_trivially_copyable_v<std::ranges::range_value_t<Range>>);
        uploadBytes(std::as_bytes(std::span(std::ranges::data(values), std::ranges::size(values))), offsetBytes);
    }
    template <typename T>
    void uploadValue(const T& value, std::size_t offsetBytes = 0) const {
        upload(std::span<const T>(&value, 1), offsetBytes);
    }
    void uploadBytes(std::span<const std::byte> source, std::size_t offsetBytes = 0) const;

    /// Fills the buffer with 0.
    void clear() const;

    /// Reads `target.size()` bytes from `offsetBytes`; waits for the GPU. Storage writes need a TransferOrUpdate
    /// barrier first.
    void download(std::span<std::byte> target, std::size_t offsetBytes = 0) const;
    template <typename T>
    std::vector<T> downloadAs(std::size_t count, std::size_t offsetBytes = 0) const {
        static_assert(std::is_trivially_copyable_v<T>);
        std::vector<T> values(count);
        download(std::as_writable_bytes(std::span(values)), offsetBytes);
        return values;
    }

    /// The buffer texture of a format, made on first use. Covers as many whole texels as the driver can read. Throws as
    /// TexelBuffer.
    const TexelBuffer& texels(graph::Format format) const;

    std::size_t bytes() const { return bytes_; }
    std::uint32_t id() const { return id_.value(); }
    const std::string& label() const { return label_; }

private:
    /// Creates no GL object.
    Buffer(std::size_t bytes, std::string label);
    Buffer(std::string label, std::span<const std::byte> contents, BufferUse use);
    /// Creates the GL buffer. Contents are undefined if `contents` is null.
    void make(const std::byte* contents, BufferUse use);

    std::string label_;
    std::size_t bytes_ = 0;
    Id id_;
    mutable std::vector<std::pair<graph::Format, std::unique_ptr<TexelBuffer>>> texels_;
};

} // namespace tessera::gpu
