#include "scenes/import/GltfMeshopt.h"

#include <algorithm>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include "base/Error.h"

namespace tessera::scenes::gltf {
namespace {

/// The vertex codec's best case is 2 bits for each group of 16 bytes, the index codecs' one byte for a triangle of 12:
/// no data decodes to more than 64 times its size, plus one block's tail (at most 8 KiB). Larger claims are refused
/// before memory is reserved for them. Source: EXT_meshopt_compression, appendix A.
constexpr std::size_t kMaxRatio = 64;
constexpr std::size_t kBlockBytes = 8192;

void checkLayout(const MeshoptLayout& layout, std::size_t encodedBytes) {
    const bool attributes = layout.mode == "ATTRIBUTES";
    if (attributes && layout.byteStride % 4 != 0)
        throw InputError(fmt::format("mode ATTRIBUTES needs a byteStride divisible by 4, not {}", layout.byteStride));
    if (!attributes && layout.byteStride != 2 && layout.byteStride != 4)
        throw InputError(fmt::format("mode {} needs a byteStride of 2 or 4, not {}", layout.mode, layout.byteStride));
    if (layout.mode == "TRIANGLES" && layout.count % 3 != 0)
        throw InputError(fmt::format("mode TRIANGLES needs a count divisible by 3, not {}", layout.count));
    if (layout.filter != "NONE" && !attributes)
        throw InputError(fmt::format("filter {} works with mode ATTRIBUTES only", layout.filter));
    if (layout.filter == "OCTAHEDRAL" && layout.byteStride != 4 && layout.byteStride != 8)
        throw InputError(fmt::format("filter OCTAHEDRAL needs a byteStride of 4 or 8, not {}", layout.byteStride));
    if (layout.filter == "QUATERNION" && layout.byteStride != 8)
        throw InputError(fmt::format("filter QUATERNION needs a byteStride of 8, not {}", layout.byteStride));
    if (layout.count > (encodedBytes * kMaxRatio + kBlockBytes) / layout.byteStride)
        throw InputError(
            fmt::format("{} bytes cannot hold {} elements of {} bytes", encodedBytes, layout.count, layout.byteStride));
}

} // namespace

std::uint64_t decodedBytes(const MeshoptLayout& layout, std::size_t encodedBytes) {
    return std::min<std::uint64_t>(layout.count * layout.byteStride, encodedBytes * kMaxRatio + kBlockBytes);
}

std::vector<std::byte> decodeMeshopt(std::span<const std::byte> encoded, const MeshoptLayout& layout) {
    checkLayout(layout, encoded.size());
    std::vector<std::byte> decoded(layout.count * layout.byteStride);
    const auto* data = reinterpret_cast<const unsigned char*>(encoded.data());
    int result = 0;
    if (layout.mode == "ATTRIBUTES")
        result = meshopt_decodeVertexBuffer(decoded.data(), layout.count, layout.byteStride, data, encoded.size());
    else if (layout.mode == "TRIANGLES")
        result = meshopt_decodeIndexBuffer(decoded.data(), layout.count, layout.byteStride, data, encoded.size());
    else
        result = meshopt_decodeIndexSequence(decoded.data(), layout.count, layout.byteStride, data, encoded.size());
    if (result != 0)
        throw InputError(
            fmt::format("its {} data is broken or of a later version (decoder error {})", layout.mode, result));

    if (layout.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(decoded.data(), layout.count, layout.byteStride);
    if (layout.filter == "QUATERNION") meshopt_decodeFilterQuat(decoded.data(), layout.count, layout.byteStride);
    if (layout.filter == "EXPONENTIAL") meshopt_decodeFilterExp(decoded.data(), layout.count, layout.byteStride);
    return decoded;
}

} // namespace tessera::scenes::gltf
