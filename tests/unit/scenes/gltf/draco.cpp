#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "DracoGrid.h"
#include "tests/support/Sweep.h"

namespace tessera::scenes::gltf::test {
namespace {

constexpr const char* kDracoPlace = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression: ";

template <typename Vector>
float mostApart(const Vector& a, const Vector& b) {
    float most = 0.0f;
    for (int i = 0; i < Vector::length(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

/// Triangles by vertex, each rotated so that its smallest index is first.
std::multiset<std::array<std::uint32_t, 3>> turnedTriangles(const std::vector<std::uint32_t>& corners,
                                                            const std::vector<std::uint32_t>& vertices) {
    std::multiset<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        std::array<std::uint32_t, 3> triangle = {vertices[corners[i]], vertices[corners[i + 1]],
                                                 vertices[corners[i + 2]]};
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
        triangles.insert(triangle);
    }
    return triangles;
}

std::vector<std::uint32_t> inOrder(std::size_t count) {
    std::vector<std::uint32_t> all(count);
    for (std::size_t i = 0; i < count; ++i) all[i] = std::uint32_t(i);
    return all;
}

/// Expects `got` to equal `wanted` up to the order of vertices and triangles, and to quantisation. The steps are those
/// of the widest component: 5 in 14 bits, 1 in 12, 2 in 12; 10 bits of a normal are 2e-3 apart on its octahedron.
void expectNearly(const Shape& got, const Shape& wanted) {
    const std::size_t count = wanted.rest.positionsOS.size();
    ASSERT_EQ(got.rest.positionsOS.size(), count);
    std::vector<std::uint32_t> vertices; // of `wanted`
    for (const glm::vec3& position : got.rest.positionsOS) {
        const auto nearest = std::ranges::min_element(
            wanted.rest.positionsOS, {}, [&](const glm::vec3& other) { return mostApart(position, other); });
        EXPECT_LT(mostApart(position, *nearest), 5.0f / 16383.0f);
        vertices.push_back(std::uint32_t(nearest - wanted.rest.positionsOS.begin()));
    }
    EXPECT_EQ(std::set<std::uint32_t>(vertices.begin(), vertices.end()).size(), count) << "each vertex once";
    const auto expectNear = [&](const char* name, const auto& values, const auto& others, float tolerance) {
        ASSERT_EQ(values.size(), count) << name;
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_LE(mostApart(values[i], others[vertices[i]]), tolerance) << name << " of vertex " << vertices[i];
    };
    expectNear("NORMAL", got.rest.normalsOS, wanted.rest.normalsOS, 5e-3f);
    expectNear("TANGENT", got.rest.tangentsOS, wanted.rest.tangentsOS, 2e-3f);
    for (std::size_t set = 0; set < 2; ++set)
        expectNear("TEXCOORD", got.rest.texCoords[set], wanted.rest.texCoords[set], 1.0f / 4095.0f);
    expectNear("COLOR_0", got.rest.colors, wanted.rest.colors, 0.0f);
    ASSERT_EQ(got.joints.size(), wanted.joints.size());
    for (std::size_t i = 0; i < got.joints.size(); ++i) {
        const std::size_t other = vertices[i / 4] * std::size_t{4} + i % 4;
        EXPECT_EQ(got.joints[i], wanted.joints[other]) << i;
        EXPECT_NEAR(got.weights[i], wanted.weights[other], 1.0f / 4095.0f) << i;
    }
    EXPECT_EQ(turnedTriangles(got.rest.indices, vertices), turnedTriangles(wanted.rest.indices, inOrder(count)));
}

// ---- Contents of streams -------------------------------------------------------------------------------------------

TEST(GltfDraco, aTriangleWrittenAfterTheSpecificationIsRead) {
    Builder builder;
    addDraco(builder, dracoTriangle());
    const Mesh mesh = builder.import().meshes.at(0);
    const std::vector<glm::vec3> corners = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
    EXPECT_EQ(mesh.positionsOS, corners) << "those of the stream, not those of the plain accessor beside it";
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(GltfDraco, aLosslessStreamIsTheModelWithoutCompression) {
    const Grid grid;
    const Shape wanted = grid.document().import().rig.shapes.at(0);
    const Builder builder = compressed(grid, grid.lossless());
    const Shape got = builder.import().rig.shapes.at(0);
    EXPECT_EQ(got.rest.positionsOS, wanted.rest.positionsOS);
    EXPECT_EQ(got.rest.normalsOS, wanted.rest.normalsOS);
    EXPECT_EQ(got.rest.tangentsOS, wanted.rest.tangentsOS);
    EXPECT_EQ(got.rest.texCoords[0], wanted.rest.texCoords[0]);
    EXPECT_EQ(got.rest.texCoords[1], wanted.rest.texCoords[1]);
    EXPECT_EQ(got.rest.colors, wanted.rest.colors);
    EXPECT_EQ(got.rest.indices, wanted.rest.indices);
    EXPECT_EQ(got.joints, wanted.joints);
    EXPECT_EQ(got.weights, wanted.weights);
    EXPECT_EQ(got.influences, wanted.influences);
}

TEST(GltfDraco, quantisedStreamsAreTheModelToTheirSteps) {
    const Grid grid;
    const Shape wanted = grid.document().import().rig.shapes.at(0);
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING})
        for (const int speed : {0, 5, 10}) {
            SCOPED_TRACE(testing::Message() << "method " << method << ", speed " << speed);
            const Builder builder = compressed(grid, grid.quantised(method, speed));
            ASSERT_EQ(builder.error(), "");
            expectNearly(builder.import().rig.shapes.at(0), wanted);
        }
}

TEST(GltfDraco, attributesOutsideTheStreamAndMorphTargetsAreReadAsUsual) {
    Builder builder;
    builder.attribute("TEXCOORD_0", "VEC2", {0, 0, 1, 0, 0, 1});
    builder.target({0, 0, 1, 0, 0, 2, 0, 0, 3});
    builder.json["meshes"][0]["weights"] = Json::array({1});
    addDraco(builder, dracoTriangle());
    const Shape shape = builder.import().rig.shapes.at(0);
    EXPECT_EQ(shape.rest.positionsOS.at(1), glm::vec3(2, 0, 0));
    EXPECT_EQ(shape.rest.texCoords[0].at(2), glm::vec2(0, 1));
    EXPECT_EQ(shape.targets.at(0).positionsOS.at(2), glm::vec3(0, 0, 3));
}

TEST(GltfDraco, whatIsEncodedAsStripsIsAList) {
    Builder builder;
    builder.primitive()["mode"] = 5;
    addDraco(builder, dracoTriangle());
    EXPECT_EQ(builder.import().meshes.at(0).indices, (std::vector<std::uint32_t>{0, 1, 2}));
    builder.primitive()["mode"] = 6;
    EXPECT_THAT(builder.error(), HasSubstr("/meshes/0/primitives/0/mode: is 6, a fan"));
    builder.primitive()["mode"] = 1;
    EXPECT_THAT(builder.error(), HasSubstr("/meshes/0/primitives/0/mode: is 1, points or lines"));
}

TEST(GltfDraco, modelsOfTheAssetsFolderAreRead) {
    const char* assets = std::getenv("TESSERA_ASSETS");
    const std::filesystem::path folder = assets == nullptr ? "" : assets;
    if (!std::filesystem::exists(folder / "Box-Draco/Box.gltf")) GTEST_SKIP() << "TESSERA_ASSETS has no Box-Draco";
    const Mesh box = underLedger(importGltf, folder / "Box-Draco/Box.gltf").meshes.at(0);
    EXPECT_EQ(box.positionsOS.size(), 24u);
    EXPECT_EQ(box.indices.size(), 36u);
    for (const glm::vec3& position : box.positionsOS)
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(std::abs(position[i]), 0.5f, 1e-3f);
    const Scene morphed = underLedger(importGltf, folder / "MorphPrimitivesTest-Draco/MorphPrimitivesTest.gltf");
    ASSERT_EQ(morphed.rig.shapes.size(), 2u);
    EXPECT_EQ(morphed.rig.shapes[0].rest.positionsOS.size(), 21u);
    EXPECT_EQ(morphed.rig.shapes[1].rest.positionsOS.size(), 9u);
}

// ---- Refused streams -----------------------------------------------------------------------------------------------

/// Cuts streams at every byte; a reduced sweep at every fifth.
void expectStreamsCutShortRefused() {
    const Grid grid;
    for (const Bytes& good : {grid.lossless(), grid.quantised(draco::MESH_EDGEBREAKER_ENCODING, 0)}) {
        Builder builder = compressed(grid, good);
        for (std::size_t size = 1; size < good.size(); size += ::tessera::test::isWholeSweep() ? 1 : 5) {
            setStream(builder, Bytes(good.begin(), good.begin() + std::ptrdiff_t(size)));
            const std::string error = builder.error();
            EXPECT_THAT(error, HasSubstr("model.gltf: ")) << size << " of " << good.size();
            EXPECT_THAT(error, HasSubstr(std::string(kDracoPlace) + "the stream of mesh 'grid' ")) << error;
        }
    }
}

TEST(GltfDraco, streamsCutShortAreRefusedByFileAndMesh) {
    expectStreamsCutShortRefused();
}
TEST(GltfDracoSlow, streamsCutShortAreRefusedByFileAndMesh) {
    expectStreamsCutShortRefused();
}

/// Changes every byte in three ways; a reduced sweep in one of them, by turns.
void expectChangedBytesReadOrRefused() {
    const Grid grid;
    for (const Bytes& good :
         {grid.quantised(draco::MESH_SEQUENTIAL_ENCODING, 5), grid.quantised(draco::MESH_EDGEBREAKER_ENCODING, 0),
          grid.quantised(draco::MESH_EDGEBREAKER_ENCODING, 10)}) {
        Builder builder = compressed(grid, good);
        std::size_t refusedCount = 0;
        constexpr unsigned kChanges[] = {0x01u, 0x80u, 0xffu};
        for (std::size_t at = 0; at < good.size(); ++at)
            for (const unsigned change : ::tessera::test::inTurn(kChanges, at)) {
                Bytes harmed = good;
                harmed[at] ^= std::byte(change);
                SCOPED_TRACE(testing::Message() << "byte " << at << " changed by " << change);
                setStream(builder, harmed);
                refusedCount += builder.error().empty() ? 0 : 1; // exceptions other than InputError escape
            }
        EXPECT_GT(refusedCount, 0u);
    }
}
TEST(GltfDraco, anyChangedByteIsReadOrRefused) {
    expectChangedBytesReadOrRefused();
}
TEST(GltfDracoSlow, anyChangedByteIsReadOrRefused) {
    expectChangedBytesReadOrRefused();
}

/// Returns the error of dracoTriangle() with another byte in its header.
std::string errorWithByte(std::size_t at, unsigned value) {
    Builder builder;
    Bytes stream = dracoTriangle();
    stream.at(at) = std::byte(value);
    addDraco(builder, stream);
    return builder.error();
}

TEST(GltfDraco, headersOfOtherStreamsAreRefused) {
    EXPECT_THAT(errorWithByte(0, 'd'),
                HasSubstr(std::string(kDracoPlace) + "the stream of mesh 'mesh 0' is no stream of Draco"));
    EXPECT_THAT(errorWithByte(6, 1), HasSubstr("is of version 2.1 of Draco's format; 2.2 is glTF's"));
    EXPECT_THAT(errorWithByte(7, 0), HasSubstr("is of points, not of a mesh"));
    EXPECT_THAT(errorWithByte(8, 7), HasSubstr("is of the unknown method 7; compress the mesh anew"));
}

TEST(GltfDraco, streamsThatAreNotAsTheirAccessorsSayAreRefused) {
    const auto errorAfter = [](auto change, DracoClaims claims = {}) {
        Builder builder;
        Json& draco = addDraco(builder, dracoTriangle(claims));
        change(builder, draco);
        return builder.error();
    };
    const auto nothing = [](Builder&, Json&) {};
    EXPECT_EQ(errorAfter(nothing), "");
    EXPECT_THAT(errorAfter([](Builder&, Json& draco) { draco["attributes"]["POSITION"] = 99; }),
                HasSubstr("holds no attribute 99, which POSITION names"));
    EXPECT_THAT(errorAfter([](Builder& builder, Json&) { builder.json["accessors"][0]["count"] = 2; }),
                HasSubstr("holds 3 vertices, but accessor 0 of POSITION says 2"));
    EXPECT_THAT(errorAfter([](Builder& builder, Json&) { builder.json["accessors"][0]["type"] = "VEC2"; }),
                HasSubstr("holds POSITION with 3 components an element, but accessor 0 says 2"));
    EXPECT_THAT(errorAfter([](Builder& builder, Json&) {
                    builder.indices<std::uint16_t>({0, 1, 2, 2, 1, 0});
                }),
                HasSubstr("holds 1 triangles, but accessor 1 says 6 indices"));
    EXPECT_THAT(errorAfter(nothing, {.componentType = 11}),
                HasSubstr("holds POSITION in a component type that glTF does not"));
    EXPECT_THAT(errorAfter([](Builder&, Json& draco) { draco["bufferView"] = 9; }),
                HasSubstr("points at /bufferViews/9"));
    EXPECT_THAT(errorAfter([](Builder&, Json& draco) { draco.erase("bufferView"); }),
                HasSubstr("the required property 'bufferView' is missing"));
}

TEST(GltfDraco, anIndexBeyondTheVerticesIsRefused) {
    Builder builder;
    Bytes stream = dracoTriangle();
    stream.at(16) = std::byte{7}; // behind the header, two counts and the method: the last index
    addDraco(builder, stream);
    EXPECT_THAT(builder.error(), HasSubstr(kDracoPlace)) << builder.error();
}

} // namespace
} // namespace tessera::scenes::gltf::test
