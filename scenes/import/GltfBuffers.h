#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "scenes/import/GltfDocument.h"

namespace tessera::scenes::gltf {

/// The bytes behind buffer views: buffers are read, and views that EXT_meshopt_compression packs decoded, on first use.
class Buffers {
public:
    explicit Buffers(const Document& document) : document_(document) {}

    /// The bytes of a buffer view, decompressed, valid as long as this object. Throws InputError naming the view or the
    /// buffer.
    std::span<const std::byte> view(int bufferView);
    /// Bytes charged to the ledger that this object keeps until its end.
    std::uint64_t heldBytes() const { return heldBytes_; }

private:
    std::span<const std::byte> buffer(int index);
    std::span<const std::byte> slice(int buffer, std::size_t byteOffset, std::size_t byteLength,
                                     const std::string& place);
    std::vector<std::byte> decompress(int bufferView, const tiny::Value& meshopt);

    const Document& document_;
    std::map<int, std::vector<std::byte>> buffers_;      ///< those read from URIs
    std::map<int, std::string> broken_;                  ///< why others cannot be read
    std::map<int, std::vector<std::byte>> decompressed_; ///< by buffer view
    std::uint64_t heldBytes_ = 0;
};

} // namespace tessera::scenes::gltf
