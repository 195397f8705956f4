#pragma once
#include <memory>

#include "scenes/import/GltfDocument.h"

namespace draco {
class Mesh;
}

namespace tessera::scenes::gltf {

/// Contents of buffer views. Buffers are read, and views of EXT_meshopt_compression decoded, on first use.
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
    std::map<int, std::string> broken_;                  ///< reasons why others cannot be read
    std::map<int, std::vector<std::byte>> decompressed_; ///< by buffer view
    std::uint64_t heldBytes_ = 0;
};

/// An accessor's elements as floats: normalised integers in 0..1 or -1..1, other integers as their value.
struct Elements {
    std::size_t count = 0;
    int components = 0; ///< 1..4 per element, or 16 for a column-major 4x4 matrix
    bool normalized = false;
    int componentType = 0; ///< TINYGLTF_COMPONENT_TYPE_...
    std::vector<float> values;
};

/// Calls `use` with a value of the C++ type of a component type.
template <typename Use>
decltype(auto) withComponent(int componentType, Use&& use) {
    if (componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) return use(float{}); // the most common
    if (componentType == TINYGLTF_COMPONENT_TYPE_BYTE) return use(std::int8_t{});
    if (componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return use(std::uint8_t{});
    if (componentType == TINYGLTF_COMPONENT_TYPE_SHORT) return use(std::int16_t{});
    if (componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return use(std::uint16_t{});
    return use(std::uint32_t{});
}

/// Size of one component.
inline std::size_t bytesOf(int componentType) {
    return std::size_t(tiny::GetComponentSizeInBytes(std::uint32_t(componentType)));
}

/// Reads accessors of every form: interleaved, tightly packed, normalised, sparse, sparse without a buffer view. Every
/// range is checked before it is read or memory is reserved for it; throws InputError naming the accessor.
class Accessors {
public:
    Accessors(const Document& document, Buffers& buffers) : document_(document), buffers_(buffers) {}

    /// `packed`, if not empty, replaces the accessor's buffer view: all its elements, tightly packed.
    Elements elements(int accessor, std::span<const std::byte> packed = {});
    std::vector<std::uint32_t> indices(int accessor);

private:
    struct Source;
    Source placed(int accessor, int bufferView, std::size_t byteOffset, std::size_t count, int type,
                  std::size_t components, std::size_t byteStride);
    const tiny::Accessor& accessorAt(int index) const;
    template <typename Value, typename Convert>
    std::vector<Value> read(int accessor, std::span<const std::byte> packed, Convert convert);

    const Document& document_;
    Buffers& buffers_;
};

/// A primitive decoded from a stream of KHR_draco_mesh_compression.
struct DracoGeometry {
    /// By name. Elements are tightly packed, with the component type and count of the attribute's accessor.
    std::map<std::string, std::vector<std::byte>> attributes;
    std::vector<std::uint32_t> corners; ///< three per triangle
};

/// The Draco streams in a document's buffer views. A stream that several primitives share is decoded once and kept.
class DracoStreams {
public:
    DracoStreams(const Document& document, Buffers& buffers);

    /// Decodes the stream of a primitive that has one; `place` is the primitive's. The sizes that the stream claims are
    /// compared with the accessors and charged to the ledger before memory is allocated; only the result and kept
    /// streams stay charged. Throws InputError naming the file, the primitive and the mesh if the stream is broken, is
    /// not a mesh, or contradicts the accessors. Source: KHR_draco_mesh_compression; Draco bitstream specification 2.2.
    DracoGeometry decode(const tiny::Primitive& primitive, const std::string& place, const std::string& meshName);
    /// Bytes charged to the ledger that this object keeps until its end.
    std::uint64_t heldBytes() const { return heldBytes_; }

private:
    const Document& document_;
    Buffers& buffers_;
    std::map<int, std::size_t> primitives_;                    ///< number of primitives, by buffer view
    std::map<int, std::shared_ptr<const draco::Mesh>> shared_; ///< decoded, by buffer view
    std::uint64_t heldBytes_ = 0;
};

} // namespace tessera::scenes::gltf
