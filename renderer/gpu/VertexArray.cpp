#include "renderer/gpu/VertexArray.h"

#include <cassert>

#include <fmt/format.h>
#include <glad/gl.h>

#include "renderer/gpu/Debug.h"

namespace tessera::gpu {

VertexArray::VertexArray(std::string label, std::span<const VertexAttribute> attributes, const Buffer* indices) {
    std::uint32_t id = 0;
    glCreateVertexArrays(1, &id);
    id_ = Id(id);
    for (const VertexAttribute& attribute : attributes) {
        assert(attribute.components >= 1 && attribute.components <= 4);
        assert((!attribute.integer || attribute.type == VertexType::Uint32) && "only Uint32 is read as an integer");
        const GLuint location = attribute.location;
        glEnableVertexArrayAttrib(id, location);
        if (attribute.integer)
            glVertexArrayAttribIFormat(id, location, attribute.components, GL_UNSIGNED_INT, 0);
        else if (attribute.type == VertexType::Uint8Normalised)
            glVertexArrayAttribFormat(id, location, attribute.components, GL_UNSIGNED_BYTE, GL_TRUE, 0);
        else
            glVertexArrayAttribFormat(id, location, attribute.components,
                                      attribute.type == VertexType::Float ? GL_FLOAT : GL_UNSIGNED_INT, GL_FALSE, 0);
        // One binding per attribute: simple, and every driver has at least as many bindings as attributes.
        if (attribute.buffer) setBuffer(attribute, *attribute.buffer);
        glVertexArrayAttribBinding(id, location, location);
        glVertexArrayBindingDivisor(id, location, attribute.divisor);
    }
    if (indices) glVertexArrayElementBuffer(id, indices->id());
    labelObject(LabelKind::VertexArray, id, label);
    try {
        throwIfFailed(fmt::format("creating vertex array '{}'", label));
    } catch (...) {
        glDeleteVertexArrays(1, &id);
        throw;
    }
}

void VertexArray::setBuffer(const VertexAttribute& attribute, const Buffer& buffer) const {
    glVertexArrayVertexBuffer(id_.value(), attribute.location, buffer.id(), GLintptr(attribute.offset),
                              GLsizei(attribute.stride));
}

VertexArray::~VertexArray() {
    if (const std::uint32_t id = id_.value()) glDeleteVertexArrays(1, &id);
}

} // namespace tessera::gpu
