#include <algorithm>
#include <array>
#include <cassert>

#include <glad/gl.h>

#include "renderer/gpu/Program.h"

namespace tessera::gpu {
namespace {

GLenum blockInterface(BlockKind kind) {
    return kind == BlockKind::Uniform ? GL_UNIFORM_BLOCK : GL_SHADER_STORAGE_BLOCK;
}
GLenum memberInterface(BlockKind kind) {
    return kind == BlockKind::Uniform ? GL_UNIFORM : GL_BUFFER_VARIABLE;
}

GLuint blockIndex(std::uint32_t program, std::string_view block, BlockKind kind) {
    return glGetProgramResourceIndex(program, blockInterface(kind), std::string(block).c_str());
}

GLint property(std::uint32_t program, GLenum programInterface, GLuint index, GLenum name) {
    GLint value = 0;
    glGetProgramResourceiv(program, programInterface, index, 1, &name, 1, nullptr, &value);
    return value;
}

bool isSampler(GLenum type) {
    switch (type) {
    case GL_SAMPLER_1D:
    case GL_SAMPLER_2D:
    case GL_SAMPLER_3D:
    case GL_SAMPLER_CUBE:
    case GL_SAMPLER_2D_RECT:
    case GL_SAMPLER_1D_ARRAY:
    case GL_SAMPLER_2D_ARRAY:
    case GL_SAMPLER_CUBE_MAP_ARRAY:
    case GL_SAMPLER_BUFFER:
    case GL_SAMPLER_2D_MULTISAMPLE:
    case GL_SAMPLER_2D_MULTISAMPLE_ARRAY:
    case GL_INT_SAMPLER_1D:
    case GL_INT_SAMPLER_2D:
    case GL_INT_SAMPLER_3D:
    case GL_INT_SAMPLER_CUBE:
    case GL_INT_SAMPLER_2D_RECT:
    case GL_INT_SAMPLER_1D_ARRAY:
    case GL_INT_SAMPLER_2D_ARRAY:
    case GL_INT_SAMPLER_CUBE_MAP_ARRAY:
    case GL_INT_SAMPLER_BUFFER:
    case GL_INT_SAMPLER_2D_MULTISAMPLE:
    case GL_INT_SAMPLER_2D_MULTISAMPLE_ARRAY:
    case GL_UNSIGNED_INT_SAMPLER_1D:
    case GL_UNSIGNED_INT_SAMPLER_2D:
    case GL_UNSIGNED_INT_SAMPLER_3D:
    case GL_UNSIGNED_INT_SAMPLER_CUBE:
    case GL_UNSIGNED_INT_SAMPLER_2D_RECT:
    case GL_UNSIGNED_INT_SAMPLER_1D_ARRAY:
    case GL_UNSIGNED_INT_SAMPLER_2D_ARRAY:
    case GL_UNSIGNED_INT_SAMPLER_CUBE_MAP_ARRAY:
    case GL_UNSIGNED_INT_SAMPLER_BUFFER:
    case GL_UNSIGNED_INT_SAMPLER_2D_MULTISAMPLE:
    case GL_UNSIGNED_INT_SAMPLER_2D_MULTISAMPLE_ARRAY:
    case GL_SAMPLER_1D_SHADOW:
    case GL_SAMPLER_2D_SHADOW:
    case GL_SAMPLER_CUBE_SHADOW:
    case GL_SAMPLER_2D_RECT_SHADOW:
    case GL_SAMPLER_1D_ARRAY_SHADOW:
    case GL_SAMPLER_2D_ARRAY_SHADOW:
    case GL_SAMPLER_CUBE_MAP_ARRAY_SHADOW:
        return true;
    default:
        return false;
    }
}

GLenum referencedBy(Stage stage) {
    switch (stage) {
    case Stage::Vertex:
        return GL_REFERENCED_BY_VERTEX_SHADER;
    case Stage::Geometry:
        return GL_REFERENCED_BY_GEOMETRY_SHADER;
    case Stage::Fragment:
        return GL_REFERENCED_BY_FRAGMENT_SHADER;
    case Stage::Compute:
        return GL_REFERENCED_BY_COMPUTE_SHADER;
    }
    assert(false);
    return GL_NONE;
}

/// GL returns -1 for properties that do not apply; maps it to 0.
std::size_t byteProperty(std::uint32_t program, GLenum programInterface, GLuint index, GLenum name) {
    return std::size_t(std::max(property(program, programInterface, index, name), 0));
}

} // namespace

std::vector<BlockMember> Program::blockMembers(std::string_view block, BlockKind kind) const {
    const GLuint index = blockIndex(id(), block, kind);
    if (index == GL_INVALID_INDEX) return {};
    const GLint count = property(id(), blockInterface(kind), index, GL_NUM_ACTIVE_VARIABLES);
    std::vector<GLint> variables(static_cast<std::size_t>(count));
    const GLenum activeVariables = GL_ACTIVE_VARIABLES;
    glGetProgramResourceiv(id(), blockInterface(kind), index, 1, &activeVariables, count, nullptr, variables.data());

    const GLenum members = memberInterface(kind);
    std::vector<BlockMember> result;
    for (const GLint variable : variables) {
        const GLuint member = GLuint(variable);
        BlockMember& entry = result.emplace_back();
        entry.name.resize(std::size_t(property(id(), members, member, GL_NAME_LENGTH)));
        GLsizei length = 0;
        glGetProgramResourceName(id(), members, member, GLsizei(entry.name.size()), &length, entry.name.data());
        entry.name.resize(std::size_t(length));
        entry.offset = byteProperty(id(), members, member, GL_OFFSET);
        entry.arrayStride = byteProperty(id(), members, member, GL_ARRAY_STRIDE);
        entry.matrixStride = byteProperty(id(), members, member, GL_MATRIX_STRIDE);
        if (kind == BlockKind::Storage)
            entry.topArrayStride = byteProperty(id(), members, member, GL_TOP_LEVEL_ARRAY_STRIDE);
    }
    std::sort(result.begin(), result.end(),
              [](const BlockMember& a, const BlockMember& b) { return a.offset < b.offset; });
    return result;
}

std::size_t Program::blockBytes(std::string_view block, BlockKind kind) const {
    const GLuint index = blockIndex(id(), block, kind);
    return index == GL_INVALID_INDEX ? 0 : byteProperty(id(), blockInterface(kind), index, GL_BUFFER_DATA_SIZE);
}

int Program::blockSlot(std::string_view block, BlockKind kind) const {
    const GLuint index = blockIndex(id(), block, kind);
    return index == GL_INVALID_INDEX ? -1 : property(id(), blockInterface(kind), index, GL_BUFFER_BINDING);
}

int Program::samplerUnit(std::string_view uniform) const {
    const GLint location = glGetUniformLocation(id(), std::string(uniform).c_str());
    if (location < 0) return -1;
    GLint unit = -1;
    glGetUniformiv(id(), location, &unit);
    return unit;
}

int Program::sampledTextures(Stage stage) const {
    GLint uniforms = 0;
    glGetProgramInterfaceiv(id(), GL_UNIFORM, GL_ACTIVE_RESOURCES, &uniforms);
    int sampled = 0;
    for (GLint uniform = 0; uniform < uniforms; ++uniform) {
        const std::array<GLenum, 3> properties{GL_TYPE, GL_ARRAY_SIZE, referencedBy(stage)};
        std::array<GLint, 3> values{};
        glGetProgramResourceiv(id(), GL_UNIFORM, GLuint(uniform), GLsizei(properties.size()), properties.data(),
                               GLsizei(values.size()), nullptr, values.data());
        if (isSampler(GLenum(values[0])) && values[2] != 0) sampled += values[1];
    }
    return sampled;
}

} // namespace tessera::gpu
