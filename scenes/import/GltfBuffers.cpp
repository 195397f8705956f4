#include "scenes/import/GltfBuffers.h"

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/import/FileBytes.h"
#include "scenes/import/GltfMeshopt.h"
#include "scenes/import/GltfUri.h"

namespace tessera::scenes::gltf {

using Json = nlohmann::json;

std::span<const std::byte> Buffers::buffer(int index) {
    const std::string place = fmt::format("/buffers/{}", index);
    const Json& buffer = document_.json["buffers"][static_cast<std::size_t>(index)];
    const auto byteLength = buffer["byteLength"].get<std::size_t>();
    std::span<const std::byte> bytes;
    if (const auto uri = buffer.find("uri"); uri != buffer.end()) {
        auto found = buffers_.find(index);
        if (found == buffers_.end()) {
            const std::uint64_t mark = document_.ledger.usedBytes();
            const std::string& text = uri->get_ref<const std::string&>();
            const bool isData = isDataUri(text);
            if (isData) document_.charge(2 * text.size(), "buffers", index);
            try {
                found = buffers_
                            .emplace(index, isData ? decodeDataUri(text)
                                                   : readFileBytes(fileOfUri(text, document_.folder), document_.ledger))
                            .first;
            } catch (const InputError& error) {
                document_.fail(place, error.what());
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
    if (bytes.size() < byteLength)
        document_.fail(place, fmt::format("says {} bytes, but its data has only {}", byteLength, bytes.size()));
    return bytes.first(byteLength);
}

std::span<const std::byte> Buffers::slice(int bufferIndex, const Json& range, const std::string& place) {
    const std::span<const std::byte> bytes = buffer(bufferIndex);
    const auto offset = range.value("byteOffset", std::size_t{0});
    const auto length = range["byteLength"].get<std::size_t>();
    // Both are at most 2^53 (GltfShape), so their sum does not wrap.
    if (offset + length > bytes.size())
        document_.fail(place,
                       fmt::format("reads {} bytes past the end of buffer {} (byteOffset {} + byteLength {} > {})",
                                   offset + length - bytes.size(), bufferIndex, offset, length, bytes.size()));
    return bytes.subspan(offset, length);
}

std::vector<std::byte> Buffers::decompress(int bufferView, const Json& extension) {
    const std::string place = fmt::format("/bufferViews/{}/extensions/EXT_meshopt_compression", bufferView);
    const std::string mode = extension["mode"].get<std::string>();
    const std::string filter = extension.value("filter", std::string("NONE"));
    const MeshoptLayout layout{extension["count"].get<std::size_t>(), extension["byteStride"].get<std::size_t>(), mode,
                               filter};
    const std::span<const std::byte> encoded = slice(extension["buffer"].get<int>(), extension, place);
    document_.charge(decodedBytes(layout, encoded.size()), "bufferViews", bufferView);
    heldBytes_ += decodedBytes(layout, encoded.size());
    try {
        return decodeMeshopt(encoded, layout);
    } catch (const InputError& error) {
        document_.fail(place, error.what());
    }
}

std::span<const std::byte> Buffers::view(int bufferView) {
    const Json& view = document_.json["bufferViews"][static_cast<std::size_t>(bufferView)];
    if (const auto extensions = view.find("extensions"); extensions != view.end()) {
        if (const auto compressed = extensions->find("EXT_meshopt_compression"); compressed != extensions->end()) {
            auto found = decompressed_.find(bufferView);
            if (found == decompressed_.end())
                found = decompressed_.emplace(bufferView, decompress(bufferView, *compressed)).first;
            return found->second;
        }
    }
    return slice(view["buffer"].get<int>(), view, fmt::format("/bufferViews/{}", bufferView));
}

} // namespace tessera::scenes::gltf
