#include "renderer/gpu/ConstantRing.h"

#include <cstring>
#include <stdexcept>

#include <fmt/format.h>
#include <glad/gl.h>

#include "renderer/gpu/Debug.h"

namespace tessera::gpu {
namespace {

constexpr std::size_t kHalfBytes = std::size_t(1) << 18;

/// Alignment of uniform range offsets that every GL accepts (the largest GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT allowed).
constexpr std::size_t kAlignment = 256;

} // namespace

ConstantRing::ConstantRing() {
    constexpr GLbitfield kFlags = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    std::uint32_t id = 0;
    glCreateBuffers(1, &id);
    buffer_ = Id(id);
    glNamedBufferStorage(id, GLsizeiptr(2 * kHalfBytes), nullptr, kFlags);
    memory_ = static_cast<std::byte*>(glMapNamedBufferRange(id, 0, GLsizeiptr(2 * kHalfBytes), kFlags));
    labelObject(LabelKind::Buffer, id, "constants of passes");
    if (memory_ == nullptr) {
        glDeleteBuffers(1, &id);
        throwIfFailed("mapping the constants of passes");
        throw std::runtime_error("the driver does not map the buffer for constants of passes");
    }
}

ConstantRing::~ConstantRing() {
    for (void* fence : fences_)
        if (fence != nullptr) glDeleteSync(static_cast<GLsync>(fence));
    if (const std::uint32_t id = buffer_.value()) glDeleteBuffers(1, &id);
}

void ConstantRing::bind(std::uint32_t slot, std::span<const std::byte> bytes) {
    if (bytes.empty() || bytes.size() > kMostBytes)
        throw std::logic_error(
            fmt::format("constants of {} bytes; a uniform block may have 1 to {}", bytes.size(), kMostBytes));
    if (used_ + bytes.size() > kHalfBytes) takeOtherHalf();
    const std::size_t offset = half_ * kHalfBytes + used_;
    std::memcpy(memory_ + offset, bytes.data(), bytes.size());
    glBindBufferRange(GL_UNIFORM_BUFFER, slot, buffer_.value(), GLintptr(offset), GLsizeiptr(bytes.size()));
    used_ = (used_ + bytes.size() + kAlignment - 1) / kAlignment * kAlignment;
}

void ConstantRing::takeOtherHalf() {
    fences_[half_] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    half_ = 1 - half_;
    used_ = 0;
    void*& fence = fences_[half_];
    if (fence == nullptr) return;
    constexpr GLuint64 kForever = ~GLuint64(0);
    glClientWaitSync(static_cast<GLsync>(fence), GL_SYNC_FLUSH_COMMANDS_BIT, kForever);
    glDeleteSync(static_cast<GLsync>(fence));
    fence = nullptr;
}

} // namespace tessera::gpu
