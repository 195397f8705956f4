#include "renderer/gpu/Buffer.h"

#include <array>
#include <cassert>

#include <fmt/format.h>
#include <glad/gl.h>

#include "renderer/gpu/Debug.h"
#include "renderer/gpu/TexelBuffer.h"

namespace tessera::gpu {
namespace {

constexpr std::size_t kLeastBytes = 16; // GL has no empty buffers
// More than any machine has. A request for 64 TiB blocks NVIDIA 580 for a minute.
constexpr std::size_t kMostBytes = std::size_t(1) << 40;

GLbitfield storageFlags(BufferUse use) {
    switch (use) {
    case BufferUse::Static:
    case BufferUse::Dynamic:
        return GL_DYNAMIC_STORAGE_BIT;
    case BufferUse::Readback:
        return GL_DYNAMIC_STORAGE_BIT | GL_MAP_READ_BIT | GL_CLIENT_STORAGE_BIT;
    }
    assert(false);
    return 0;
}

} // namespace

Buffer::Buffer(std::size_t bytes, std::string label)
    : label_(std::move(label)), bytes_(bytes == 0 ? kLeastBytes : bytes) {}

// The delegated constructor has completed, so if the body throws, the destructor deletes the buffer.
Buffer::Buffer(std::string label, std::size_t bytes, BufferUse use) : Buffer(bytes, std::move(label)) {
    make(nullptr, use);
    clear();
    throwIfAllocationFailed(fmt::format("buffer '{}'", label_), bytes_);
}

Buffer::Buffer(std::string label, std::span<const std::byte> contents, BufferUse use)
    : Buffer(contents.size(), std::move(label)) {
    constexpr std::array<std::byte, kLeastBytes> kNothing{};
    make(contents.empty() ? kNothing.data() : contents.data(), use);
}

void Buffer::make(const std::byte* contents, BufferUse use) {
    throwIfFailed(fmt::format("before creating buffer '{}'", label_));
    if (bytes_ > kMostBytes) failAllocation(fmt::format("buffer '{}'", label_), bytes_);
    std::uint32_t id = 0;
    glCreateBuffers(1, &id);
    id_ = Id(id);
    glNamedBufferStorage(id, GLsizeiptr(bytes_), contents, storageFlags(use));
    throwIfAllocationFailed(fmt::format("buffer '{}'", label_), bytes_);
    labelObject(LabelKind::Buffer, id, label_);
}

Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;

Buffer::~Buffer() {
    texels_.clear(); // before the buffer that they view
    if (const std::uint32_t id = id_.value()) glDeleteBuffers(1, &id);
}

const TexelBuffer& Buffer::texels(graph::Format format) const {
    for (const auto& [known, view] : texels_)
        if (known == format) return *view;
    return *texels_.emplace_back(format, std::make_unique<TexelBuffer>(label_, format, *this)).second;
}

void Buffer::uploadBytes(std::span<const std::byte> source, std::size_t offsetBytes) const {
    assert(offsetBytes + source.size() <= bytes_ && "upload beyond the buffer's end");
    if (!source.empty())
        glNamedBufferSubData(id_.value(), GLintptr(offsetBytes), GLsizeiptr(source.size()), source.data());
}

void Buffer::clear() const {
    const std::uint8_t zero = 0;
    glClearNamedBufferData(id_.value(), GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, &zero); // any size
    // NVIDIA 580 lets a glNamedBufferSubData of more than 64 KiB overtake the clear, which then erases what it wrote.
    glFinish();
}

void Buffer::download(std::span<std::byte> target, std::size_t offsetBytes) const {
    assert(offsetBytes + target.size() <= bytes_ && "download beyond the buffer's end");
    if (!target.empty())
        glGetNamedBufferSubData(id_.value(), GLintptr(offsetBytes), GLsizeiptr(target.size()), target.data());
    throwIfFailed(fmt::format("reading buffer '{}'", label_));
}

} // namespace tessera::gpu
