#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace tessera::scenes::gltf {

/// The properties of EXT_meshopt_compression on a buffer view.
struct MeshoptLayout {
    std::size_t count = 0;
    std::size_t byteStride = 0;
    std::string_view mode;   ///< ATTRIBUTES, TRIANGLES or INDICES
    std::string_view filter; ///< NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
};

/// The bytes that the layout says, as far as `encodedBytes` can hold them.
std::uint64_t decodedBytes(const MeshoptLayout& layout, std::size_t encodedBytes);

/// `layout.count` elements of `layout.byteStride` bytes. Throws InputError with the reason when the layout breaks a
/// rule of the extension or the data is broken.
std::vector<std::byte> decodeMeshopt(std::span<const std::byte> encoded, const MeshoptLayout& layout);

} // namespace tessera::scenes::gltf
