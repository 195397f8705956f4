#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "renderer/gpu/Buffer.h"

namespace tessera::gpu {

enum class VertexType { Float, Uint8Normalised, Uint32 };

struct VertexAttribute {
    std::uint32_t location = 0;
    int components = 1; ///< 1..4
    VertexType type = VertexType::Float;
    const Buffer* buffer = nullptr; ///< must outlive the vertex array; null: set by setBuffer() before drawing
    std::size_t offset = 0;         ///< bytes, of the first element
    std::size_t stride = 0;         ///< bytes between elements; 0: the same value for every vertex
    std::uint32_t divisor = 0;      ///< 0: per vertex; n: a new element every n instances
    bool integer = false;           ///< the shader reads int or uint, not float; Uint32 only
};

/// A vertex array object: vertex attributes and 32-bit indices.
class VertexArray {
public:
    /// `indices` may be null when nothing indexed is drawn.
    VertexArray(std::string label, std::span<const VertexAttribute> attributes, const Buffer* indices);
    ~VertexArray();
    VertexArray(VertexArray&&) noexcept = default;
    VertexArray& operator=(VertexArray&&) noexcept = default;

    /// Binds another buffer to an attribute.
    void setBuffer(const VertexAttribute& attribute, const Buffer& buffer) const;

    std::uint32_t id() const { return id_.value(); }

private:
    Id id_;
};

} // namespace tessera::gpu
