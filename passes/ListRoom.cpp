#include "passes/ListRoom.h"

#include <stdexcept>

#include <fmt/format.h>

#include "base/Error.h"
#include "renderer/gpu/Context.h"

namespace tessera::passes {

namespace {

constexpr const char* kRemedy = "larger tiles, another culling method or fewer lights need less";

const gpu::Buffer& allocate(const graph::PassContext& context, graph::BufferHandle handle, std::size_t bytes) {
    try {
        return context.allocate(handle, bytes);
    } catch (const std::logic_error&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}; {}", error.what(), kRemedy));
    }
}

} // namespace

void requireReadable(const char* what, std::size_t texels) {
    const std::size_t most = gpu::Context::current()->capabilities().maxTextureBufferTexels;
    if (texels > most)
        throw InputError(
            fmt::format("{} would take {} texels, and this driver reads {}: {}", what, texels, most, kRemedy));
}

const gpu::Buffer& makeTexelRoom(const graph::PassContext& context, graph::BufferHandle handle, const char* what,
                                 std::size_t texels, graph::Format format) {
    requireReadable(what, texels);
    return allocate(context, handle, texels * std::size_t(graph::formatInfo(format).bytes));
}

const gpu::Buffer& makeBlockRoom(const graph::PassContext& context, graph::BufferHandle handle, const char* what,
                                 std::size_t bytes) {
    const std::size_t most = gpu::Context::current()->capabilities().maxStorageBlockBytes;
    if (bytes > most)
        throw InputError(
            fmt::format("{} would take {} bytes, and this driver reads {}: {}", what, bytes, most, kRemedy));
    return allocate(context, handle, bytes);
}

void requireWritable(const char* what, std::size_t bytes) {
    const std::size_t most = gpu::Context::current()->capabilities().maxStorageBlockBytes;
    if (bytes <= most) return;
    throw InputError(
        fmt::format("{} would take {} bytes, and shaders of this driver write {} at most: build them on the CPU, "
                    "or use larger tiles or fewer lights",
                    what, bytes, most));
}

} // namespace tessera::passes
