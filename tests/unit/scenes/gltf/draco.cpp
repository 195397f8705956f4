#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <set>
#include <utility>

#include <draco/compression/encode.h>
#include <gtest/gtest.h>

#include "DracoStream.h"
#include "tests/support/Sweep.h"

namespace tessera::scenes::gltf::test {
namespace {

constexpr std::size_t kGridSide = 6, kGridVertices = kGridSide * kGridSide; ///< of the grid
constexpr const char* kDracoPlace = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression: ";

/// A vertex attribute of a document and of a stream.
struct Attribute {
    const char* name;
    draco::GeometryAttribute::Type kind;
    draco::DataType type;
    int componentType;
    std::size_t components;
    bool normalized;
    Bytes bytes; ///< of all vertices
};

/// A bumpy grid with all attributes that the importer reads.
struct Grid {
    std::vector<Attribute> attributes;
    std::vector<std::uint16_t> corners;

    Grid() {
        using draco::GeometryAttribute;
        std::vector<float> positions, normals, tangents, uv0, uv1, weights;
        std::vector<std::uint8_t> colors, joints;
        const auto add = [](auto& to, auto... values) {
            (to.push_back(static_cast<typename std::decay_t<decltype(to)>::value_type>(values)), ...);
        };
        for (std::size_t y = 0; y < kGridSide; ++y)
            for (std::size_t x = 0; x < kGridSide; ++x) {
                const float u = static_cast<float>(x) / (kGridSide - 1), v = static_cast<float>(y) / (kGridSide - 1);
                add(positions, 5.0f * u, 5.0f * v, 0.25f * static_cast<float>(x * y % 3));
                const glm::vec3 normal = glm::normalize(glm::vec3(u - 0.5f, v - 0.5f, 1.0f));
                const glm::vec3 tangent = glm::normalize(glm::cross(glm::vec3(0, 1, 0), normal));
                add(normals, normal.x, normal.y, normal.z);
                add(tangents, tangent.x, tangent.y, tangent.z, x < 3 ? 1.0f : -1.0f);
                add(uv0, u, v);
                add(uv1, v, 1.0f - u);
                add(colors, 40 * x, 50 * y, 100, 255);
                add(joints, x % 2, 1 - x % 2, 0, 0);
                add(weights, 0.75f, 0.25f, 0.0f, 0.0f);
            }
        for (std::size_t y = 0; y + 1 < kGridSide; ++y)
            for (std::size_t x = 0; x + 1 < kGridSide; ++x) {
                const std::size_t a = y * kGridSide + x, b = a + 1, c = a + kGridSide, d = c + 1;
                add(corners, a, b, c, c, b, d);
            }
        constexpr int kFloat = 5126, kByte = 5121;
        const auto floats = [&](const char* name, GeometryAttribute::Type kind, std::size_t components, auto& values) {
            attributes.push_back({name, kind, draco::DT_FLOAT32, kFloat, components, false, bytesOf(values)});
        };
        floats("POSITION", GeometryAttribute::POSITION, 3, positions);
        floats("NORMAL", GeometryAttribute::NORMAL, 3, normals);
        floats("TANGENT", GeometryAttribute::GENERIC, 4, tangents);
        floats("TEXCOORD_0", GeometryAttribute::TEX_COORD, 2, uv0);
        floats("TEXCOORD_1", GeometryAttribute::TEX_COORD, 2, uv1);
        attributes.push_back({"COLOR_0", GeometryAttribute::COLOR, draco::DT_UINT8, kByte, 4, true, bytesOf(colors)});
        attributes.push_back(
            {"JOINTS_0", GeometryAttribute::GENERIC, draco::DT_UINT8, kByte, 4, false, bytesOf(joints)});
        floats("WEIGHTS_0", GeometryAttribute::GENERIC, 4, weights);
    }

    /// A document that shows it without compression, on a skin of two joints.
    Builder document() const {
        Builder builder;
        builder.merge(R"({"nodes": [{"mesh": 0, "skin": 0}, {}, {}], "scenes": [{"nodes": [0, 1, 2]}],
                          "skins": [{"joints": [1, 2]}]})");
        builder.json["meshes"][0]["name"] = "grid";
        Json& named = builder.primitive()["attributes"] = Json::object();
        for (const Attribute& attribute : attributes)
            named[attribute.name] = builder.add(std::vector<std::byte>(attribute.bytes), attribute.componentType,
                                                std::array{"", "SCALAR", "VEC2", "VEC3", "VEC4"}[attribute.components],
                                                kGridVertices, attribute.normalized);
        builder.primitive()["indices"] = builder.add(corners, 5123, "SCALAR", corners.size());
        return builder;
    }

    std::unique_ptr<draco::Mesh> mesh() const {
        auto mesh = std::make_unique<draco::Mesh>();
        mesh->set_num_points(kGridVertices);
        for (const Attribute& attribute : attributes) {
            const std::size_t bytesEach = attribute.bytes.size() / kGridVertices;
            draco::GeometryAttribute layout;
            layout.Init(attribute.kind, nullptr, static_cast<std::uint8_t>(attribute.components), attribute.type,
                        attribute.normalized, static_cast<std::int64_t>(bytesEach), 0);
            draco::PointAttribute& added = *mesh->attribute(mesh->AddAttribute(layout, true, kGridVertices));
            for (std::uint32_t i = 0; i < kGridVertices; ++i)
                added.SetAttributeValue(draco::AttributeValueIndex(i), attribute.bytes.data() + i * bytesEach);
        }
        for (std::size_t i = 0; i < corners.size(); i += 3)
            mesh->AddFace(
                {draco::PointIndex(corners[i]), draco::PointIndex(corners[i + 1]), draco::PointIndex(corners[i + 2])});
        return mesh;
    }

    /// By names, in the order of mesh().
    Json identifiers() const {
        Json named = Json::object();
        for (std::size_t i = 0; i < attributes.size(); ++i) named[attributes[i].name] = i;
        return named;
    }

    Bytes encoded(draco::Encoder& encoder) const {
        draco::EncoderBuffer buffer;
        const draco::Status status = encoder.EncodeMeshToBuffer(*mesh(), &buffer);
        EXPECT_TRUE(status.ok()) << status.error_msg_string();
        return bytesOf(std::vector<char>(buffer.data(), buffer.data() + buffer.size()));
    }
    /// All bits of all values, and vertices and triangles in their order.
    Bytes lossless() const {
        draco::Encoder encoder;
        encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
        return encoded(encoder);
    }
    Bytes quantised(int method, int speed) const {
        using draco::GeometryAttribute;
        draco::Encoder encoder;
        encoder.SetEncodingMethod(method);
        encoder.SetSpeedOptions(speed, speed);
        for (const auto& [kind, bits] :
             {std::pair(GeometryAttribute::POSITION, 14), std::pair(GeometryAttribute::NORMAL, 10),
              std::pair(GeometryAttribute::TEX_COORD, 12), std::pair(GeometryAttribute::GENERIC, 12)})
            encoder.SetAttributeQuantization(kind, bits);
        return encoded(encoder);
    }
};

/// The document of a grid whose stream stands for all accessors' data.
Builder compressed(const Grid& grid, const Bytes& stream) {
    Builder builder = grid.document();
    for (const auto& [name, accessor] : builder.primitive()["attributes"].items())
        builder.json["accessors"][accessor.get<std::size_t>()].erase("bufferView");
    builder.json["accessors"][builder.primitive()["indices"].get<std::size_t>()].erase("bufferView");
    addDraco(builder, stream, grid.identifiers());
    return builder;
}

/// Another stream in a document that compressed() made.
void setStream(Builder& builder, const Bytes& stream) {
    builder.json["buffers"].back() = {{"uri", dataUri(stream)}, {"byteLength", stream.size()}};
    builder.json["bufferViews"].back()["byteLength"] = stream.size();
}

template <typename Vector>
float mostApart(const Vector& a, const Vector& b) {
    float most = 0.0f;
    for (int i = 0; i < Vector::length(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

/// The triangles by vertices, each turned so that its smallest is first.
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
    for (std::size_t i = 0; i < count; ++i) all[i] = static_cast<std::uint32_t>(i);
    return all;
}

/// `got` is `wanted` but for the order of vertices and triangles, and for what quantisation takes. The steps are those
/// of the widest component: 5 in 14 bits, 1 in 12, 2 in 12; 10 bits of a normal are 2e-3 apart on its octahedron.
void expectNearly(const Shape& got, const Shape& wanted) {
    const std::size_t count = wanted.rest.positionsOS.size();
    ASSERT_EQ(got.rest.positionsOS.size(), count);
    std::vector<std::uint32_t> vertices; // of `wanted`
    for (const glm::vec3& position : got.rest.positionsOS) {
        const auto nearest = std::ranges::min_element(
            wanted.rest.positionsOS, {}, [&](const glm::vec3& other) { return mostApart(position, other); });
        EXPECT_LT(mostApart(position, *nearest), 5.0f / 16383.0f);
        vertices.push_back(static_cast<std::uint32_t>(nearest - wanted.rest.positionsOS.begin()));
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

// ---- What streams hold ---------------------------------------------------------------------------------------------

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
    builder.primitive()["attributes"]["TEXCOORD_0"] =
        builder.add(std::vector<float>{0, 0, 1, 0, 0, 1}, 5126, "VEC2", 3);
    const int moved = builder.add(std::vector<float>{0, 0, 1, 0, 0, 2, 0, 0, 3}, 5126, "VEC3", 3);
    builder.primitive()["targets"] = Json::array({Json::object({{"POSITION", moved}})});
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
    EXPECT_NE(builder.error().find("/meshes/0/primitives/0/mode: is 6, a fan"), std::string::npos);
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

// ---- What is refused -----------------------------------------------------------------------------------------------

/// At every byte, or at each fifth.
void expectStreamsCutShortRefused() {
    const Grid grid;
    for (const Bytes& good : {grid.lossless(), grid.quantised(draco::MESH_EDGEBREAKER_ENCODING, 0)}) {
        Builder builder = compressed(grid, good);
        for (std::size_t size = 1; size < good.size(); size += ::tessera::test::isWholeSweep() ? 1 : 5) {
            setStream(builder, Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)));
            const std::string error = builder.error();
            EXPECT_NE(error.find("model.gltf: "), std::string::npos) << size << " of " << good.size();
            EXPECT_NE(error.find(std::string(kDracoPlace) + "the stream of mesh 'grid' "), std::string::npos) << error;
        }
    }
}

TEST(GltfDraco, streamsCutShortAreRefusedByFileAndMesh) {
    expectStreamsCutShortRefused();
}
TEST(GltfDracoSlow, streamsCutShortAreRefusedByFileAndMesh) {
    expectStreamsCutShortRefused();
}

/// Every byte in three ways, or in one in turn.
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
                harmed[at] ^= static_cast<std::byte>(change);
                SCOPED_TRACE(testing::Message() << "byte " << at << " changed by " << change);
                setStream(builder, harmed);
                refusedCount += builder.error().empty() ? 0 : 1; // throws what is not an InputError
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

/// Of the triangle by hand, with another byte in its header.
std::string errorWithByte(std::size_t at, unsigned value) {
    Builder builder;
    Bytes stream = dracoTriangle();
    stream.at(at) = static_cast<std::byte>(value);
    addDraco(builder, stream);
    return builder.error();
}

TEST(GltfDraco, headersOfOtherStreamsAreRefused) {
    EXPECT_NE(
        errorWithByte(0, 'd').find(std::string(kDracoPlace) + "the stream of mesh 'mesh 0' is no stream of Draco"),
        std::string::npos);
    EXPECT_NE(errorWithByte(6, 1).find("is of version 2.1 of Draco's format; 2.2 is glTF's"), std::string::npos);
    EXPECT_NE(errorWithByte(7, 0).find("is of points, not of a mesh"), std::string::npos);
    EXPECT_NE(errorWithByte(8, 7).find("is of the unknown method 7; compress the mesh anew"), std::string::npos);
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
    EXPECT_NE(errorAfter([](Builder&, Json& draco) {
                  draco["attributes"]["POSITION"] = 99;
              }).find("holds no attribute 99, which POSITION names"),
              std::string::npos);
    EXPECT_NE(errorAfter([](Builder& builder, Json&) {
                  builder.json["accessors"][0]["count"] = 2;
              }).find("holds 3 vertices, but accessor 0 of POSITION says 2"),
              std::string::npos);
    EXPECT_NE(errorAfter([](Builder& builder, Json&) {
                  builder.json["accessors"][0]["type"] = "VEC2";
              }).find("holds POSITION with 3 components an element, but accessor 0 says 2"),
              std::string::npos);
    EXPECT_NE(errorAfter([](Builder& builder, Json&) {
                  builder.primitive()["indices"] =
                      builder.add(std::vector<std::uint16_t>{0, 1, 2, 2, 1, 0}, 5123, "SCALAR", 6);
              }).find("holds 1 triangles, but accessor 1 says 6 indices"),
              std::string::npos);
    EXPECT_NE(errorAfter(nothing, {.componentType = 11}).find("holds POSITION in a component type that glTF does not"),
              std::string::npos);
    EXPECT_NE(errorAfter([](Builder&, Json& draco) { draco["bufferView"] = 9; }).find("points at /bufferViews/9"),
              std::string::npos);
    EXPECT_NE(errorAfter([](Builder&, Json& draco) {
                  draco.erase("bufferView");
              }).find("the required property 'bufferView' is missing"),
              std::string::npos);
}

TEST(GltfDraco, anIndexBeyondTheVerticesIsRefused) {
    Builder builder;
    Bytes stream = dracoTriangle();
    stream.at(16) = std::byte{7}; // behind the header, two counts and the method: the last index
    addDraco(builder, stream);
    EXPECT_NE(builder.error().find(kDracoPlace), std::string::npos) << builder.error();
}

// ---- Memory --------------------------------------------------------------------------------------------------------

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
    faces.primitive()["indices"] = faces.add(std::vector<std::uint16_t>{0, 1, 2}, 5123, "SCALAR", 3);
    addDraco(faces, dracoTriangle({.faces = kMany}));
    EXPECT_NE(faces.error().find("holds 1073741824 triangles, but accessor 1 says 3 indices"), std::string::npos)
        << faces.error();
    // Nothing says how many triangles a primitive without indices has.
    faces.primitive().erase("indices");
    EXPECT_NE(refusal(faces).find("/KHR_draco_mesh_compression: asks for 240.0 GiB"), std::string::npos)
        << refusal(faces);

    Builder vertices;
    Json& stream = addDraco(vertices, dracoTriangle({.faces = 20000, .vertices = 60000, .components = 255}));
    EXPECT_NE(vertices.error().find("holds 60000 vertices, but accessor 0 of POSITION says 3"), std::string::npos)
        << vertices.error();
    // Nor what an attribute holds that nobody names.
    stream["attributes"] = Json::object();
    EXPECT_NE(refusal(vertices).find("/KHR_draco_mesh_compression: asks for "), std::string::npos) << refusal(vertices);
}

TEST(GltfDraco, whatADecoderTookIsGivenBack) {
    const Grid grid;
    Builder builder = compressed(grid, grid.lossless());
    const Json primitive = builder.primitive();
    for (int i = 0; i < 20; ++i) builder.json["meshes"][0]["primitives"].push_back(primitive);
    // Twenty decoders one after another, each of which has tables of 8 MiB.
    EXPECT_EQ(underLedger(importGltf, builder.folder.write("model.gltf", builder.json.dump()), 32 * kMiB).meshes.size(),
              21u);
}

} // namespace
} // namespace tessera::scenes::gltf::test
