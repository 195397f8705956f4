#pragma once
#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

#include "renderer/gpu/Framebuffer.h"
#include "renderer/gpu/PipelineState.h"
#include "renderer/graph/Compile.h"

/// GL commands of passes, on the current context. No state caching: drivers drop redundant binds themselves.
namespace tessera::gpu {

class Buffer;
class Program;
class Sampler;
class TexelBuffer;
class VertexArray;

/// A rectangle of pixels, from the lower-left corner.
struct Rectangle {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    bool operator==(const Rectangle&) const = default;
};

// ---- Targets -------------------------------------------------------------------------------------------------------

/// Binds a framebuffer, sets the viewport to its size, disables the scissor test and enables sRGB encoding.
void bindFramebuffer(const Framebuffer& framebuffer);
/// Binds the window's framebuffer, of this size in pixels. Disables sRGB encoding, since colours written there are
/// encoded already.
void bindWindowFramebuffer(int width, int height);
void setViewport(int x, int y, int width, int height);
/// Restricts draws and clears to a rectangle (an atlas tile), until the next bindFramebuffer().
void setScissor(const Rectangle& pixels);

/// Clears an attachment of the bound framebuffer within the scissor, regardless of write masks.
void clearColor(int attachment, const glm::vec4& color);
void clearDepth(float depth); ///< reverse-Z: 0 is infinitely far

/// Copies (or resolves samples) between framebuffers of equal size: colour attachment 0 and/or depth. Disables the
/// scissor test.
void blit(const Framebuffer& from, const Framebuffer& to, bool color, bool depth);
/// Copies a part of colour attachment 0 to the bound window's framebuffer, scaled to `target`; equal sizes copy texels
/// exactly. The scissor applies.
void blitToWindow(const Framebuffer& from, const Rectangle& source, const Rectangle& target, bool smooth);

// ---- State and bindings --------------------------------------------------------------------------------------------

void setState(const PipelineState& state);
void useProgram(const Program& program);
void useProgram(Program&& program) = delete; ///< a temporary would be destroyed before the draw
void bindVertexArray(const VertexArray& vertexArray);

enum class ImageAccess { Read, Write, ReadWrite };
/// A null sampler uses the texture's filtering: nearest, clamped.
void bindTexture(std::uint32_t unit, const Texture& texture, const Sampler* sampler = nullptr);
void bindTexelBuffer(std::uint32_t unit, const TexelBuffer& buffer);
void bindImage(std::uint32_t unit, const Texture& texture, ImageAccess access, const graph::Part& part = {});
void bindUniformBuffer(std::uint32_t slot, const Buffer& buffer); ///< the whole buffer
void bindUniformBuffer(std::uint32_t slot, const Buffer& buffer, std::size_t offset, std::size_t bytes);
void bindStorageBuffer(std::uint32_t slot, const Buffer& buffer);
void bindStorageBuffer(std::uint32_t slot, const Buffer& buffer, std::size_t offset, std::size_t bytes);

// ---- Work ----------------------------------------------------------------------------------------------------------

/// Draws a triangle that covers the target, from gl_VertexID 0, 1, 2 without vertex buffers. Unbinds the vertex array.
/// Under BandedDrawing, draws in bands (Bands.h).
void drawFullscreenTriangle();
/// Draws `count` vertices (three per triangle) from gl_VertexID, `instances` times. Unbinds the vertex array.
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
/// Draws `count` tightly packed commands from `commands`, starting at index `first`.
void drawIndexedIndirect(const Buffer& commands, std::uint32_t first, std::uint32_t count);

void dispatch(std::uint32_t groupsX, std::uint32_t groupsY = 1, std::uint32_t groupsZ = 1);
/// Makes earlier image and storage writes visible to the named accesses; the graph calls it between passes.
void memoryBarrier(graph::Barrier barrier);
/// Blocks until the GPU is done.
void finish();

} // namespace tessera::gpu
