#pragma once
#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

#include "renderer/gpu/Framebuffer.h"
#include "renderer/gpu/PipelineState.h"
#include "renderer/graph/Compile.h"

/// The GL calls passes make, on the current context. Nothing is filtered here: drivers drop redundant binds themselves.
namespace tessera::gpu {

class Buffer;
class Program;
class Sampler;
class TexelBuffer;
class VertexArray;

/// Pixels from the lower-left corner.
struct Rectangle {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    bool operator==(const Rectangle&) const = default;
};

// ---- Targets -------------------------------------------------------------------------------------------------------

/// Binds and sets the viewport to the whole of it; scissoring is switched off.
void bindFramebuffer(const Framebuffer& framebuffer);
/// The window's own framebuffer, of this size in pixels; what is written there is encoded already, nothing is
/// converted.
void bindWindowFramebuffer(int width, int height);
void setViewport(int x, int y, int width, int height);
/// Restricts draws and clears to a rectangle of pixels (an atlas tile); off with the next bindFramebuffer().
void setScissor(const Rectangle& pixels);

/// Clears of the bound framebuffer, whatever the pipeline state's write masks say; the scissor holds.
void clearColor(int attachment, const glm::vec4& color);
void clearDepth(float depth); ///< reverse-Z: 0 is infinitely far

/// Copies (or resolves samples) between framebuffers of equal size: colour attachment 0 and/or depth. Scissoring is
/// switched off.
void blit(const Framebuffer& from, const Framebuffer& to, bool color, bool depth);
/// Copies a part of colour attachment 0 to the bound window's framebuffer, stretched to `target`; where the sizes are
/// equal every texel is copied as it is. The scissor holds.
void blitToWindow(const Framebuffer& from, const Rectangle& source, const Rectangle& target, bool smooth);

// ---- State and bindings --------------------------------------------------------------------------------------------

void setState(const PipelineState& state);
void useProgram(const Program& program);
void useProgram(Program&& program) = delete; ///< it would be gone before anything is drawn
void bindVertexArray(const VertexArray& vertexArray);

enum class ImageAccess { Read, Write, ReadWrite };
/// A null sampler uses the texture's own filtering: nearest, clamped.
void bindTexture(std::uint32_t unit, const Texture& texture, const Sampler* sampler = nullptr);
void bindTexelBuffer(std::uint32_t unit, const TexelBuffer& buffer);
void bindImage(std::uint32_t unit, const Texture& texture, ImageAccess access, const graph::Part& part = {});
void bindUniformBuffer(std::uint32_t slot, const Buffer& buffer); ///< all of it
void bindUniformBuffer(std::uint32_t slot, const Buffer& buffer, std::size_t offset, std::size_t bytes);
void bindStorageBuffer(std::uint32_t slot, const Buffer& buffer);
void bindStorageBuffer(std::uint32_t slot, const Buffer& buffer, std::size_t offset, std::size_t bytes);

// ---- Work ----------------------------------------------------------------------------------------------------------

/// One triangle that covers the target, from gl_VertexID alone: vertices 0, 1, 2. Unbinds the vertex array. In bands
/// (Bands.h) where draws are.
void drawFullscreenTriangle();
/// `count` vertices (three a triangle) by gl_VertexID alone, `instances` times. Unbinds the vertex
/// array.
void drawVertices(int count, int instances = 1);
void drawIndexed(std::uint32_t firstIndex, std::uint32_t indexCount, int baseVertex = 0, std::uint32_t baseInstance = 0,
                 std::uint32_t instances = 1);

/// One draw of drawIndexedIndirect(), in GL's layout.
struct DrawIndexedCommand {
    std::uint32_t indexCount = 0;
    std::uint32_t instances = 1;
    std::uint32_t firstIndex = 0;
    std::int32_t baseVertex = 0;
    std::uint32_t baseInstance = 0;
};
/// `count` tightly packed commands from `commands`, beginning with number `first`.
void drawIndexedIndirect(const Buffer& commands, std::uint32_t first, std::uint32_t count);

void dispatch(std::uint32_t groupsX, std::uint32_t groupsY = 1, std::uint32_t groupsZ = 1);
/// Names the accesses that must see earlier image and storage writes; the graph calls it between passes.
void memoryBarrier(graph::Barrier barrier);
/// Blocks until the GPU is done.
void finish();

} // namespace tessera::gpu
