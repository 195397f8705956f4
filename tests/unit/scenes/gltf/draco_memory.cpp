// Memory of Draco streams while they are decoded, and of the decoded meshes.
#include "DracoGrid.h"
#include "scenes/import/GltfBuffers.h"

namespace tessera::scenes::gltf::test {
namespace {

TEST(GltfDraco, claimsOfAStreamAreRefusedBeforeMemoryIsReserved) {
    const auto refusal = [](const Builder& builder) -> std::string {
        try {
            underLedger(importGltf, builder.folder.write("model.gltf", builder.json.dump()), 64 * kMiB);
        } catch (const MemoryRefused& refused) {
            return refused.what();
        }
        return "";
    };
    constexpr std::uint32_t kMany = 1u << 30;
    Builder faces;
    faces.indices<std::uint16_t>({0, 1, 2});
    addDraco(faces, dracoTriangle({.faces = kMany}));
    EXPECT_THAT(faces.error(), HasSubstr("holds 1073741824 triangles, but accessor 1 says 3 indices")) << faces.error();
    // No accessor limits the triangles of a primitive without indices.
    faces.primitive().erase("indices");
    EXPECT_THAT(refusal(faces), HasSubstr("/KHR_draco_mesh_compression: needs 240.0 GiB")) << refusal(faces);

    Builder vertices;
    Json& stream = addDraco(vertices, dracoTriangle({.faces = 20000, .vertices = 60000, .components = 255}));
    EXPECT_THAT(vertices.error(), HasSubstr("holds 60000 vertices, but accessor 0 of POSITION says 3"))
        << vertices.error();
    // Nor does one limit an attribute that is not named.
    stream["attributes"] = Json::object();
    EXPECT_THAT(refusal(vertices), HasSubstr("/KHR_draco_mesh_compression: needs ")) << refusal(vertices);
}

TEST(GltfDraco, whatADecoderTookIsGivenBack) {
    const Grid grid;
    const Bytes stream = grid.lossless();
    Builder builder = compressed(grid, stream);
    for (int i = 0; i < 20; ++i) {
        Json primitive = builder.primitive();
        primitive["extensions"]["KHR_draco_mesh_compression"]["bufferView"] = builder.addView(stream);
        builder.json["meshes"][0]["primitives"].push_back(std::move(primitive));
    }
    // Twenty decoders in sequence, each with tables of 8 MiB.
    EXPECT_EQ(underLedger(importGltf, builder.folder.write("model.gltf", builder.json.dump()), 32 * kMiB).meshes.size(),
              21u);
}

/// A decoder needs tables of 8 MiB; the decoded grid does not.
TEST(GltfDraco, aStreamOfSeveralPrimitivesIsDecodedOnce) {
    const Grid grid;
    Builder builder = compressed(grid, grid.quantised(draco::MESH_EDGEBREAKER_ENCODING, 5));
    Json& primitives = builder.json["meshes"][0]["primitives"];
    Json second = primitives[0];
    second["extensions"]["KHR_draco_mesh_compression"]["attributes"].erase("COLOR_0");
    primitives.push_back(second);
    LoadLedger ledger(64 * kMiB);
    Repairs repairs(false);
    const Document document = loadDocument(builder.folder.write("model.gltf", builder.json.dump()), ledger, repairs);
    Buffers buffers(document);
    DracoStreams streams(document, buffers);
    const std::vector<tiny::Primitive>& stored = document.model.meshes[0].primitives;
    const std::uint64_t before = ledger.usedBytes() - buffers.heldBytes();
    const DracoGeometry first = streams.decode(stored[0], "/meshes/0/primitives/0", "grid");
    std::uint64_t geometryBytes = first.corners.size() * sizeof(std::uint32_t);
    for (const auto& [name, bytes] : first.attributes) geometryBytes += bytes.size();
    EXPECT_GT(streams.heldBytes(), 0u);
    EXPECT_EQ(ledger.usedBytes(), before + buffers.heldBytes() + streams.heldBytes() + geometryBytes);

    ledger.charge(63 * kMiB - ledger.usedBytes(), [] { return "all but a mebibyte"; });
    const std::uint64_t heldBytes = streams.heldBytes();
    const DracoGeometry again = streams.decode(stored[1], "/meshes/0/primitives/1", "grid");
    EXPECT_EQ(again.corners, first.corners);
    EXPECT_EQ(again.attributes.at("POSITION"), first.attributes.at("POSITION"));
    EXPECT_FALSE(again.attributes.contains("COLOR_0")) << "each gets what it names";
    EXPECT_EQ(streams.heldBytes(), heldBytes);
    DracoStreams others(document, buffers);
    EXPECT_THROW(others.decode(stored[1], "/meshes/0/primitives/1", "grid"), MemoryRefused) << "who decodes needs more";
}

TEST(GltfDraco, aSharedStreamIsComparedWithTheAccessorsOfEachPrimitive) {
    Builder builder;
    addDraco(builder, dracoTriangle());
    Json second = builder.primitive();
    second["attributes"]["POSITION"] = builder.add("VEC3", std::vector<float>(12));
    builder.json["meshes"][0]["primitives"].push_back(second);
    EXPECT_THAT(builder.error(),
                HasSubstr("/meshes/0/primitives/1/extensions/KHR_draco_mesh_compression: the stream of mesh "
                          "'mesh 0 primitive 1' holds 3 vertices, but accessor 1 of POSITION says 4"))
        << builder.error();
    second["attributes"]["POSITION"] = 0;
    second["indices"] = builder.add<std::uint16_t>("SCALAR", {0, 1, 2, 2, 1, 0});
    builder.json["meshes"][0]["primitives"][1] = second;
    EXPECT_THAT(builder.error(), HasSubstr("holds 1 triangles, but accessor 2 says 6 indices")) << builder.error();
}

} // namespace
} // namespace tessera::scenes::gltf::test
