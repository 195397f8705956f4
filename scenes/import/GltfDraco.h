#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "scenes/import/GltfBuffers.h"

namespace tessera::scenes::gltf {

/// What a stream of KHR_draco_mesh_compression holds of a primitive.
struct DracoGeometry {
    /// By name. The elements follow one another in the component type of the attribute's accessor, as many as it says.
    std::map<std::string, std::vector<std::byte>> attributes;
    std::vector<std::uint32_t> corners; ///< three a triangle
};

/// Decodes the stream of a primitive, which has one. `place` is that of the primitive. What the stream claims is
/// compared with the accessors and charged to the ledger before memory is reserved for it; of that only the result
/// stays charged. Throws InputError naming the file, the primitive and the mesh when the stream is broken, is no mesh,
/// or is not what the accessors say. Source: KHR_draco_mesh_compression; Draco bitstream specification 2.2.
DracoGeometry decodeDraco(const Document& document, Buffers& buffers, const model::Primitive& primitive,
                          const std::string& place, const std::string& meshName);

} // namespace tessera::scenes::gltf
