#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scenes/import/GltfBuffers.h"

namespace draco {
class Mesh;
}

namespace tessera::scenes::gltf {

/// What a stream of KHR_draco_mesh_compression holds of a primitive.
struct DracoGeometry {
    /// By name. The elements follow one another in the component type of the attribute's accessor, as many as it says.
    std::map<std::string, std::vector<std::byte>> attributes;
    std::vector<std::uint32_t> corners; ///< three a triangle
};

/// The streams in a document's buffer views. One that several primitives name is decoded once and kept.
class DracoStreams {
public:
    DracoStreams(const Document& document, Buffers& buffers);

    /// Decodes the stream of a primitive, which has one. `place` is that of the primitive. What the stream claims is
    /// compared with the accessors and charged to the ledger before memory is reserved for it; of that only the result
    /// and what is kept stay charged. Throws InputError naming the file, the primitive and the mesh when the stream is
    /// broken, is no mesh, or is not what the accessors say. Source: KHR_draco_mesh_compression; Draco bitstream
    /// specification 2.2.
    DracoGeometry decode(const tiny::Primitive& primitive, const std::string& place, const std::string& meshName);
    /// Bytes charged to the ledger that this object keeps until its end.
    std::uint64_t heldBytes() const { return heldBytes_; }

private:
    const Document& document_;
    Buffers& buffers_;
    std::map<int, std::size_t> primitives_;                    ///< how many name a buffer view
    std::map<int, std::shared_ptr<const draco::Mesh>> shared_; ///< decoded, by buffer view
    std::uint64_t heldBytes_ = 0;
};

} // namespace tessera::scenes::gltf
