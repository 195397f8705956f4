#pragma once
#include <algorithm>
#include <cstdint>

#include "GltfBuilder.h"

namespace tessera::scenes::gltf::test {

/// Header values of the stream of dracoTriangle().
struct DracoClaims {
    std::uint32_t faces = 1;        ///< the first 2^15 are written
    std::uint32_t vertices = 3;     ///< at most 2^16 - 1; three are written
    std::uint8_t components = 3;    ///< of the positions
    std::uint8_t componentType = 9; ///< DT_FLOAT32
};

/// A stream of the triangle (0,0,0) (2,0,0) (0,2,0), written by hand: triangles in sequence, and the
/// positions as attribute 0, nothing compressed. Source: Draco bitstream specification 2.2.
inline Bytes dracoTriangle(DracoClaims claims = {}) {
    std::vector<std::uint8_t> bytes = {'D', 'R', 'A', 'C', 'O', 2,
                                       2,   1,   0,   0,   0}; // version, mesh, sequential, no flags
    const auto addVarint = [&](std::uint32_t value) {
        for (; value >= 128; value >>= 7) bytes.push_back(std::uint8_t(value | 128));
        bytes.push_back(std::uint8_t(value));
    };
    addVarint(claims.faces);
    addVarint(claims.vertices);
    bytes.push_back(1); // indices that are not compressed, as wide as the vertices need
    const std::size_t width = claims.vertices < 256 ? 1 : 2;
    for (std::uint32_t face = 0; face < std::min(claims.faces, 1u << 15); ++face)
        for (const std::uint8_t index : {0, 1, 2}) {
            bytes.push_back(index);
            bytes.insert(bytes.end(), width - 1, 0);
        }
    // One decoder of one attribute: POSITION, type and number of components, not normalized, identifier 0, raw values.
    bytes.insert(bytes.end(), {1, 1, 0, claims.componentType, claims.components, 0, 0, 0});
    for (const float value : {0.0f, 0.0f, 0.0f, 2.0f, 0.0f, 0.0f, 0.0f, 2.0f, 0.0f})
        for (const std::byte byte : bytesOf(std::vector<float>{value}))
            bytes.push_back(std::to_integer<std::uint8_t>(byte));
    return bytesOf(bytes);
}

/// Gives the builder's primitive a stream with attributes of these identifiers.
inline Json& addDraco(Builder& builder, const Bytes& stream,
                      const Json& identifiers = Json::object({{"POSITION", 0}})) {
    builder.merge(R"({"extensionsUsed": ["KHR_draco_mesh_compression"],
                      "extensionsRequired": ["KHR_draco_mesh_compression"]})");
    Json& draco = builder.primitive()["extensions"]["KHR_draco_mesh_compression"];
    draco = {{"bufferView", builder.addView(stream)}, {"attributes", identifiers}};
    return draco;
}

} // namespace tessera::scenes::gltf::test
