#include "scenes/import/GltfBuffers.h"

#include <algorithm>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include "base/Error.h"
#include "scenes/import/FileBytes.h"
#include "scenes/import/GltfUri.h"

namespace tessera::scenes::gltf {
namespace {

struct Meshopt {
    std::size_t count = 0;
    std::size_t byteStride = 0;
    std::string mode;   ///< ATTRIBUTES, TRIANGLES or INDICES
    std::string filter; ///< NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
};

/// The vertex codec's best case is 2 bits for each group of 16 bytes, the index codecs' one byte for a triangle of 12:
/// no data decodes to more than 64 times its size, plus one block's tail (at most 8 KiB). Larger claims are refused
/// before memory is reserved for them. Source: EXT_meshopt_compression, appendix A.
constexpr std::size_t kMaxRatio = 64;
constexpr std::size_t kBlockBytes = 8192;

/// Throws InputError with the reason when the layout breaks a rule of the extension.
void checkLayout(const Meshopt& layout, std::size_t encodedBytes) {
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

/// The bytes that the layout says, as far as `encodedBytes` can hold them.
std::uint64_t decodedBytes(const Meshopt& layout, std::size_t encodedBytes) {
    return std::min<std::uint64_t>(layout.count * layout.byteStride, encodedBytes * kMaxRatio + kBlockBytes);
}

/// `layout.count` elements of `layout.byteStride` bytes. Throws InputError with the reason when the data is broken.
std::vector<std::byte> decodeMeshopt(std::span<const std::byte> encoded, const Meshopt& layout) {
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

} // namespace

std::span<const std::byte> Buffers::buffer(int index) {
    const std::string place = fmt::format("/buffers/{}", index);
    const BufferSource& stored = document_.buffers[static_cast<std::size_t>(index)];
    std::span<const std::byte> bytes;
    if (stored.uri) {
        auto found = buffers_.find(index);
        if (found == buffers_.end()) {
            const std::uint64_t mark = document_.ledger.usedBytes();
            const std::string& uri = *stored.uri;
            const bool isData = isDataUri(uri);
            if (const auto broken = broken_.find(index); broken != broken_.end()) throw InputError(broken->second);
            if (isData) document_.charge(2 * uri.size(), "buffers", index);
            const std::filesystem::path file = isData ? std::filesystem::path() : document_.fileAt(place, uri);
            try {
                std::vector<std::byte> read = isData ? decodeDataUri(uri) : readFileBytes(file, document_.ledger);
                found = buffers_.emplace(index, std::move(read)).first;
            } catch (const MemoryRefused& error) {
                document_.fail(place, error);
            } catch (const InputError& error) {
                document_.charge(std::string_view(error.what()).size(), "buffers", index);
                broken_[index] = fmt::format("{}: {}: {}", document_.file, place, error.what());
                throw InputError(broken_[index]);
            }
            document_.ledger.settle(mark, found->second.size());
            heldBytes_ += found->second.size();
        }
        bytes = found->second;
    } else if (index == 0 && document_.binary) {
        bytes = *document_.binary;
    } else {
        document_.fail(place, "has neither a uri nor a binary chunk to be read from");
    }
    // The binary chunk and exporters' files may be padded at the end (glTF 2.0 section 4.4.3.3).
    if (bytes.size() < stored.byteLength)
        document_.repair(place, fmt::format("says {} bytes, but its data has only {}", stored.byteLength, bytes.size()),
                         "what lies beyond is left out");
    return bytes.first(std::min(stored.byteLength, bytes.size()));
}

std::span<const std::byte> Buffers::slice(int index, std::size_t byteOffset, std::size_t byteLength,
                                          const std::string& place) {
    const std::span<const std::byte> bytes = buffer(index);
    // Both are at most 2^53 (GltfProperties.h), so their sum does not wrap.
    const std::size_t end = byteOffset + byteLength;
    if (end > bytes.size())
        document_.fail(place,
                       fmt::format("reads {} bytes past the end of buffer {} (byteOffset {} + byteLength {} > {})",
                                   end - bytes.size(), index, byteOffset, byteLength, bytes.size()));
    return bytes.subspan(byteOffset, byteLength);
}

std::vector<std::byte> Buffers::decompress(int bufferView, const tiny::Value& stored) {
    const auto size = [&](const char* key) { return static_cast<std::size_t>(numberOf(valueAt(&stored, key), 0.0)); };
    const tiny::Value* const filter = valueAt(&stored, "filter");
    const Meshopt meshopt{size("count"), size("byteStride"), stringOf(valueAt(&stored, "mode")),
                          filter != nullptr ? stringOf(filter) : "NONE"};
    const std::string place = fmt::format("/bufferViews/{}/extensions/EXT_meshopt_compression", bufferView);
    const std::span<const std::byte> encoded =
        slice(integerOf(valueAt(&stored, "buffer")), size("byteOffset"), size("byteLength"), place);
    document_.charge(decodedBytes(meshopt, encoded.size()), "bufferViews", bufferView);
    try {
        std::vector<std::byte> decoded = decodeMeshopt(encoded, meshopt);
        heldBytes_ += decodedBytes(meshopt, encoded.size());
        return decoded;
    } catch (const InputError& error) {
        document_.fail(place, error);
    }
}

std::span<const std::byte> Buffers::view(int bufferView) {
    const tiny::BufferView& stored = elementAt(document_.model.bufferViews, bufferView);
    const tiny::Value* const meshopt = valueAt(stored.extensions, "EXT_meshopt_compression");
    if (meshopt == nullptr)
        return slice(stored.buffer, stored.byteOffset, stored.byteLength, fmt::format("/bufferViews/{}", bufferView));
    auto found = decompressed_.find(bufferView);
    if (found == decompressed_.end()) found = decompressed_.emplace(bufferView, decompress(bufferView, *meshopt)).first;
    return found->second;
}

} // namespace tessera::scenes::gltf
