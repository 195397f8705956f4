#include "renderer/gpu/Commands.h"

#include <cassert>
#include <utility>

#include <glad/gl.h>
#include <glm/gtc/type_ptr.hpp>

#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/Context.h"
#include "renderer/gpu/GlFormat.h"
#include "renderer/gpu/Program.h"
#include "renderer/gpu/Sampler.h"
#include "renderer/gpu/TexelBuffer.h"
#include "renderer/gpu/VertexArray.h"

namespace tessera::gpu {
namespace {

void setEnabled(GLenum capability, bool on) {
    on ? glEnable(capability) : glDisable(capability);
}

GLenum depthFunction(DepthTest test) {
    switch (test) {
    case DepthTest::Off:
    case DepthTest::Always:
        return GL_ALWAYS;
    case DepthTest::Greater:
        return GL_GREATER;
    case DepthTest::GreaterEqual:
        return GL_GEQUAL;
    case DepthTest::Equal:
        return GL_EQUAL;
    case DepthTest::Less:
        return GL_LESS;
    case DepthTest::LessEqual:
        return GL_LEQUAL;
    }
    assert(false);
    return GL_ALWAYS;
}

void setBlend(Blend blend) {
    setEnabled(GL_BLEND, blend != Blend::None);
    glBlendEquation(blend == Blend::Max ? GL_MAX : GL_FUNC_ADD);
    switch (blend) {
    case Blend::None:
    case Blend::Max:
        // Max ignores factors, but stale factors of a second output would keep Mesa from drawing into several targets.
        glBlendFunc(GL_ONE, GL_ZERO);
        break;
    case Blend::Additive:
        glBlendFunc(GL_ONE, GL_ONE);
        break;
    case Blend::AdditiveCovering:
        glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        break;
    case Blend::AlphaPremultiplied:
        glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        break;
    case Blend::AlphaStraight:
        glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        break;
    case Blend::Transmitting:
        glBlendFuncSeparate(GL_ONE, GL_SRC1_COLOR, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        break;
    }
}

/// Enables all write masks for a clear and restores them: GL applies masks to clears too.
class OpenWriteMasks {
public:
    OpenWriteMasks() {
        glGetBooleanv(GL_DEPTH_WRITEMASK, &depth_);
        glGetBooleanv(GL_COLOR_WRITEMASK, color_);
        glDepthMask(GL_TRUE);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }
    ~OpenWriteMasks() {
        glDepthMask(depth_);
        glColorMask(color_[0], color_[1], color_[2], color_[3]);
    }
    OpenWriteMasks(const OpenWriteMasks&) = delete;
    OpenWriteMasks& operator=(const OpenWriteMasks&) = delete;

private:
    GLboolean depth_ = GL_TRUE;
    GLboolean color_[4] = {};
};

constexpr std::pair<graph::Barrier, GLbitfield> kBarrierBits[] = {
    {graph::Barrier::TextureFetch, GL_TEXTURE_FETCH_BARRIER_BIT},
    {graph::Barrier::ShaderImage, GL_SHADER_IMAGE_ACCESS_BARRIER_BIT},
    {graph::Barrier::ShaderStorage, GL_SHADER_STORAGE_BARRIER_BIT},
    {graph::Barrier::Uniform, GL_UNIFORM_BARRIER_BIT},
    {graph::Barrier::Framebuffer, GL_FRAMEBUFFER_BARRIER_BIT},
    {graph::Barrier::TransferOrUpdate,
     GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT},
    {graph::Barrier::VertexAttribute, GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT},
    {graph::Barrier::ElementArray, GL_ELEMENT_ARRAY_BARRIER_BIT},
    {graph::Barrier::Command, GL_COMMAND_BARRIER_BIT},
};

} // namespace

void bindFramebuffer(const Framebuffer& framebuffer) {
    setBandedArea({0, 0, framebuffer.width(), framebuffer.height()});
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    glViewport(0, 0, framebuffer.width(), framebuffer.height());
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_FRAMEBUFFER_SRGB);
}

void bindWindowFramebuffer(int width, int height) {
    setBandedArea({0, 0, width, height});
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
    glDisable(GL_SCISSOR_TEST);
    // Some windows are sRGB-capable without a request; the values written here are already encoded.
    glDisable(GL_FRAMEBUFFER_SRGB);
}

void setViewport(int x, int y, int width, int height) {
    glViewport(x, y, width, height);
}

void setScissor(const Rectangle& pixels) {
    setBandedArea({pixels.x, pixels.y, pixels.width, pixels.height, true});
    glEnable(GL_SCISSOR_TEST);
    glScissor(pixels.x, pixels.y, pixels.width, pixels.height);
}

void clearColor(int attachment, const glm::vec4& color) {
    const OpenWriteMasks masks;
    glClearBufferfv(GL_COLOR, attachment, glm::value_ptr(color));
}

void clearDepth(float depth) {
    const OpenWriteMasks masks;
    glClearBufferfv(GL_DEPTH, 0, &depth);
}

void blit(const Framebuffer& from, const Framebuffer& to, bool color, bool depth) {
    assert(from.width() == to.width() && from.height() == to.height());
    glDisable(GL_SCISSOR_TEST);
    const GLbitfield mask = (color ? GL_COLOR_BUFFER_BIT : 0u) | (depth ? GL_DEPTH_BUFFER_BIT : 0u);
    glBlitNamedFramebuffer(from.id(), to.id(), 0, 0, from.width(), from.height(), 0, 0, to.width(), to.height(), mask,
                           GL_NEAREST);
}

void blitToWindow(const Framebuffer& from, const Rectangle& source, const Rectangle& target, bool smooth) {
    glBlitNamedFramebuffer(from.id(), 0, source.x, source.y, source.x + source.width, source.y + source.height,
                           target.x, target.y, target.x + target.width, target.y + target.height, GL_COLOR_BUFFER_BIT,
                           smooth ? GL_LINEAR : GL_NEAREST);
}

void setState(const PipelineState& state) {
    setEnabled(GL_DEPTH_TEST, state.depthTest != DepthTest::Off);
    glDepthFunc(depthFunction(state.depthTest));
    glDepthMask(state.depthWrite);
    setEnabled(GL_DEPTH_CLAMP, state.depthClamp);
    setEnabled(GL_POLYGON_OFFSET_FILL, state.slopeBias != 0.0f);
    if (GLAD_GL_ARB_polygon_offset_clamp)
        glPolygonOffsetClamp(state.slopeBias, 0.0f, state.mostSlopeBias);
    else
        glPolygonOffset(state.slopeBias, 0.0f);
    setEnabled(GL_CULL_FACE, state.cullFace != CullFace::None);
    glCullFace(state.cullFace == CullFace::Front ? GL_FRONT : GL_BACK);
    glFrontFace(state.frontFaceClockwise ? GL_CW : GL_CCW);
    setBlend(state.blend);
    const GLboolean color = state.colorWrite;
    glColorMask(color, color, color, color);
    setEnabled(GL_SAMPLE_ALPHA_TO_COVERAGE, state.alphaToCoverage);
}

void useProgram(const Program& program) {
    glUseProgram(program.id());
}
void bindVertexArray(const VertexArray& vertexArray) {
    glBindVertexArray(vertexArray.id());
}

void bindTexture(std::uint32_t unit, const Texture& texture, const Sampler* sampler) {
    glBindTextureUnit(unit, texture.id());
    glBindSampler(unit, sampler ? sampler->id() : 0);
}

void bindTexelBuffer(std::uint32_t unit, const TexelBuffer& buffer) {
    glBindTextureUnit(unit, buffer.id());
    glBindSampler(unit, 0);
}

void bindImage(std::uint32_t unit, const Texture& texture, ImageAccess access, const graph::Part& part) {
    const GlFormat& format = glFormat(texture.desc().format);
    assert(format.inImages && "this format cannot be bound as an image");
    const GLenum mode = access == ImageAccess::Read    ? GL_READ_ONLY
                        : access == ImageAccess::Write ? GL_WRITE_ONLY
                                                       : GL_READ_WRITE;
    glBindImageTexture(unit, texture.id(), part.level, GL_FALSE, part.layer, mode, format.internalFormat);
}

void bindUniformBuffer(std::uint32_t slot, const Buffer& buffer) {
    glBindBufferBase(GL_UNIFORM_BUFFER, slot, buffer.id());
}

void bindUniformBuffer(std::uint32_t slot, const Buffer& buffer, std::size_t offset, std::size_t bytes) {
    glBindBufferRange(GL_UNIFORM_BUFFER, slot, buffer.id(), GLintptr(offset), GLsizeiptr(bytes));
}

void bindStorageBuffer(std::uint32_t slot, const Buffer& buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, slot, buffer.id());
}

void bindStorageBuffer(std::uint32_t slot, const Buffer& buffer, std::size_t offset, std::size_t bytes) {
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, slot, buffer.id(), GLintptr(offset), GLsizeiptr(bytes));
}

void drawFullscreenTriangle() {
    drawInBands([] { drawVertices(3); });
}

void drawVertices(int count, int instances) {
    glBindVertexArray(Context::current()->emptyVertexArray());
    glDrawArraysInstanced(GL_TRIANGLES, 0, count, instances);
}

void drawIndexed(std::uint32_t firstIndex, std::uint32_t indexCount, int baseVertex, std::uint32_t baseInstance,
                 std::uint32_t instances) {
    const auto* offset = reinterpret_cast<const void*>(std::uintptr_t(firstIndex) * sizeof(std::uint32_t));
    glDrawElementsInstancedBaseVertexBaseInstance(GL_TRIANGLES, GLsizei(indexCount), GL_UNSIGNED_INT, offset,
                                                  GLsizei(instances), baseVertex, baseInstance);
}

void drawIndexedIndirect(const Buffer& commands, std::uint32_t first, std::uint32_t count) {
    static_assert(sizeof(DrawIndexedCommand) == 20, "the layout of DrawElementsIndirectCommand (OpenGL 4.5, 10.4)");
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.id());
    const auto* offset = reinterpret_cast<const void*>(std::uintptr_t(first) * sizeof(DrawIndexedCommand));
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, offset, GLsizei(count), 0);
}

void dispatch(std::uint32_t groupsX, std::uint32_t groupsY, std::uint32_t groupsZ) {
    glDispatchCompute(groupsX, groupsY, groupsZ);
}

void memoryBarrier(graph::Barrier barrier) {
    GLbitfield bits = 0;
    for (const auto& [flag, bit] : kBarrierBits)
        if ((barrier & flag) != graph::Barrier::None) bits |= bit;
    if (bits != 0) glMemoryBarrier(bits);
}

void finish() {
    glFinish();
}

} // namespace tessera::gpu
