#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "GltfBuilder.h"

namespace tessera::scenes::gltf::test {
namespace {

constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125,
              kFloat = 5126;

using Indices = std::vector<std::uint32_t>;

/// Five points of a fan or strip in the plane z = 0.
Builder withFivePoints(int mode) {
    Builder builder;
    builder.primitive()["attributes"]["POSITION"] =
        builder.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, kFloat, "VEC3", 5);
    builder.primitive()["attributes"]["NORMAL"] =
        builder.add(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, kFloat, "VEC3", 5);
    builder.primitive()["mode"] = mode;
    return builder;
}

TEST(GltfGeometry, triangleWithoutIndicesGetsThem) {
    const Scene scene = Builder().import();
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].indices, (Indices{0, 1, 2}));
    EXPECT_EQ(scene.meshes[0].positionsOS[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.meshes[0].name, "mesh 0");
    EXPECT_EQ(scene.nodes.at(0).name, "node 0");
    EXPECT_EQ(scene.name, "model");
    EXPECT_EQ(scene.materials.at(0).name, "default");
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfGeometry, stripKeepsItsWinding) {
    EXPECT_EQ(withFivePoints(5).import().meshes.at(0).indices, (Indices{0, 1, 2, 1, 3, 2, 2, 3, 4}));
}

TEST(GltfGeometry, fanTurnsAboutItsFirstPoint) {
    EXPECT_EQ(withFivePoints(6).import().meshes.at(0).indices, (Indices{1, 2, 0, 2, 3, 0, 3, 4, 0}));
}

TEST(GltfGeometry, stripNeverYieldsTrianglesThatNameACornerTwice) {
    Builder builder = withFivePoints(5);
    builder.primitive()["indices"] =
        builder.add(std::vector<std::uint8_t>{0, 1, 2, 2, 3, 4}, kUnsignedByte, "SCALAR", 6);
    EXPECT_EQ(builder.import().meshes.at(0).indices, (Indices{0, 1, 2, 2, 4, 3}));
}

TEST(GltfGeometry, incompleteLastTriangleIsDroppedWithAWarning) {
    const Scene scene = withFivePoints(4).import();
    EXPECT_EQ(scene.meshes.at(0).indices, (Indices{0, 1, 2}));
    EXPECT_TRUE(hasWarning(scene, "has 5 corners, which is no multiple of 3"));
}

TEST(GltfGeometry, primitiveWithoutPositionsIsSkippedWithAWarning) {
    Builder builder;
    builder.primitive()["attributes"] = {{"NORMAL", 0}};
    const Scene scene = builder.import();
    EXPECT_TRUE(scene.meshes.empty());
    EXPECT_TRUE(hasWarning(scene, "has no POSITION"));
}

TEST(GltfGeometry, indicesOfEveryWidthAreReadExactly) {
    const Indices expected = {2, 0, 1};
    Builder bytes;
    bytes.primitive()["attributes"]["NORMAL"] = 0;
    bytes.json["accessors"][0]["name"] = "both";
    Builder shorts = Builder(), ints = Builder();
    bytes.primitive()["indices"] = bytes.add(std::vector<std::uint8_t>{2, 0, 1}, kUnsignedByte, "SCALAR", 3);
    EXPECT_EQ(bytes.import().meshes.at(0).indices, expected);
    for (Builder* builder : {&shorts, &ints}) builder->primitive()["attributes"]["NORMAL"] = 0;
    shorts.primitive()["indices"] = shorts.add(std::vector<std::uint16_t>{2, 0, 1}, kUnsignedShort, "SCALAR", 3);
    EXPECT_EQ(shorts.import().meshes.at(0).indices, expected);
    ints.primitive()["indices"] = ints.add(Indices{2, 0, 1}, kUnsignedInt, "SCALAR", 3);
    EXPECT_EQ(ints.import().meshes.at(0).indices, expected);
}

TEST(GltfGeometry, missingNormalsAreFlatWithUnsharedVertices) {
    Builder builder;
    builder.primitive()["attributes"]["POSITION"] =
        builder.add(std::vector<float>{0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2}, kFloat, "VEC3", 4);
    builder.primitive()["attributes"]["TANGENT"] = builder.add(std::vector<float>(16, 1.0f), kFloat, "VEC4", 4);
    builder.primitive()["indices"] =
        builder.add(std::vector<std::uint8_t>{0, 1, 2, 0, 2, 3}, kUnsignedByte, "SCALAR", 6);
    const Mesh mesh = builder.import().meshes.at(0);
    ASSERT_EQ(mesh.positionsOS.size(), 6u);
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(mesh.normalsOS[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.normalsOS[5], glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.positionsOS[5], glm::vec3(0, 0, 2));
    EXPECT_TRUE(mesh.tangentsOS.empty());
}

TEST(GltfGeometry, normalsAndTangentsEndUnitLength) {
    Builder builder;
    builder.primitive()["attributes"]["NORMAL"] =
        builder.add(std::vector<float>{0, 0, 5, 0, 3, 4, 0, 0, 0}, kFloat, "VEC3", 3);
    builder.primitive()["attributes"]["TANGENT"] =
        builder.add(std::vector<float>{2, 0, 0, -0.5f, 1, 0, 0, 1, 0, 9, 0, 1}, kFloat, "VEC4", 3);
    const Scene scene = builder.import();
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.normalsOS[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.normalsOS[1], glm::vec3(0, 0.6f, 0.8f));
    EXPECT_EQ(mesh.normalsOS[2], glm::vec3(0, 0, 1)) << "a zero normal becomes its triangle's";
    EXPECT_TRUE(hasWarning(scene, "1 normals have no direction"));
    EXPECT_EQ(mesh.tangentsOS[0], glm::vec4(1, 0, 0, -1));
    EXPECT_EQ(mesh.tangentsOS[2], glm::vec4(0, 1, 0, 1));
}

TEST(GltfGeometry, tangentsWithoutDirectionAreLeftOutWithAWarning) {
    Builder builder;
    builder.primitive()["attributes"]["NORMAL"] =
        builder.add(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, kFloat, "VEC3", 3);
    builder.primitive()["attributes"]["TANGENT"] = builder.add(std::vector<float>(12, 0.0f), kFloat, "VEC4", 3);
    const Scene scene = builder.import();
    EXPECT_TRUE(scene.meshes.at(0).tangentsOS.empty());
    EXPECT_TRUE(hasWarning(scene, "tangents without a direction"));
}

TEST(GltfGeometry, bothTexCoordSetsAreImportedExactly) {
    Builder builder;
    builder.primitive()["attributes"]["TEXCOORD_0"] =
        builder.add(std::vector<float>{0, 1, 2, 3, 4, 5}, kFloat, "VEC2", 3);
    builder.primitive()["attributes"]["TEXCOORD_1"] = builder.add(
        std::vector<std::uint8_t>{0, 255, 51, 0, 0, 0, 255, 255, 0, 0, 0, 0}, kUnsignedByte, "VEC2", 3, true, 4);
    builder.primitive()["attributes"]["TEXCOORD_2"] = 1;
    const Scene scene = builder.import();
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.texCoords[0][2], glm::vec2(4, 5));
    EXPECT_EQ(mesh.texCoords[1][0], glm::vec2(0, 1));
    EXPECT_EQ(mesh.texCoords[1][1], glm::vec2(0, 0)) << "elements are byteStride 4 apart";
    EXPECT_TRUE(hasWarning(scene, "TEXCOORD_2 is left out"));
}

TEST(GltfGeometry, vertexColorOfEveryFormBecomesLinearRgba) {
    Builder rgb;
    rgb.primitive()["attributes"]["COLOR_0"] =
        rgb.add(std::vector<float>{.25f, .5f, 1, 0, 0, 0, 0, 0, 0}, kFloat, "VEC3", 3);
    EXPECT_EQ(rgb.import().meshes.at(0).colors.at(0), glm::vec4(.25f, .5f, 1, 1));
    Builder rgba;
    rgba.primitive()["attributes"]["COLOR_0"] = rgba.add(
        std::vector<std::uint16_t>{65535, 0, 13107, 0, 0, 0, 0, 0, 0, 0, 0, 0}, kUnsignedShort, "VEC4", 3, true);
    EXPECT_EQ(rgba.import().meshes.at(0).colors.at(0), glm::vec4(1, 0, .2f, 0));
    Builder unmarked;
    unmarked.primitive()["attributes"]["COLOR_0"] =
        unmarked.add(std::vector<std::uint8_t>(12, 51), kUnsignedByte, "VEC4", 3, false);
    const Scene scene = unmarked.import();
    EXPECT_EQ(scene.meshes.at(0).colors.at(2), glm::vec4(.2f));
    EXPECT_TRUE(hasWarning(scene, "COLOR_0: holds integers that are not marked normalized"));
}

TEST(GltfGeometry, vertexColorIsClampedToOne) {
    Builder builder;
    builder.primitive()["attributes"]["COLOR_0"] =
        builder.add(std::vector<float>{-5, 50, .5f, 2, 0, 0, 0, 0, 0, 0, 0, 0}, kFloat, "VEC4", 3);
    EXPECT_EQ(builder.import().meshes.at(0).colors.at(0), glm::vec4(0, 1, .5f, 1));
}

TEST(GltfGeometry, quantizedAttributesAreConvertedExactly) {
    Builder builder;
    builder.merge(R"({"extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"]})");
    builder.primitive()["attributes"]["POSITION"] =
        builder.add(std::vector<std::int16_t>{-300, 0, 0, 0, 300, 0, 0, 0, 0, 300, 0, 0}, kShort, "VEC3", 3, false, 8);
    builder.primitive()["attributes"]["NORMAL"] =
        builder.add(std::vector<std::int8_t>{0, 0, 127, 0, 0, 0, -128, 0, 127, 0, 0, 0}, kByte, "VEC3", 3, true, 4);
    const Mesh mesh = builder.import().meshes.at(0);
    EXPECT_EQ(mesh.positionsOS[0], glm::vec3(-300, 0, 0));
    EXPECT_EQ(mesh.positionsOS[2], glm::vec3(0, 300, 0));
    EXPECT_EQ(mesh.normalsOS[1], glm::vec3(0, 0, -1));
    EXPECT_EQ(mesh.normalsOS[2], glm::vec3(1, 0, 0));
}

TEST(GltfGeometry, interleavedAttributesAreReadExactly) {
    Builder builder;
    std::vector<float> vertices;
    for (int i = 0; i < 3; ++i)
        vertices.insert(vertices.end(), {float(i), float(i * i), 0, 0, 0, 1, 10.0f + float(i), 20});
    const int view = builder.addView(bytesOf(vertices), 32);
    Json& accessors = builder.json["accessors"];
    const auto place = [&](const char* name, const char* type, int offset) {
        accessors.push_back(Json::object(
            {{"bufferView", view}, {"byteOffset", offset}, {"componentType", kFloat}, {"type", type}, {"count", 3}}));
        builder.primitive()["attributes"][name] = accessors.size() - 1;
    };
    place("POSITION", "VEC3", 0);
    place("NORMAL", "VEC3", 12);
    place("TEXCOORD_0", "VEC2", 24);
    const Mesh mesh = builder.import().meshes.at(0);
    EXPECT_EQ(mesh.positionsOS[2], glm::vec3(2, 4, 0));
    EXPECT_EQ(mesh.normalsOS[1], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.texCoords[0][2], glm::vec2(12, 20));
}

TEST(GltfGeometry, sparseValuesReplaceTheirElements) {
    for (const bool hasView : {true, false}) {
        Builder builder;
        const int targets = builder.addView(bytesOf(std::vector<std::uint16_t>{1, 2}));
        const int values = builder.addView(bytesOf(std::vector<float>{7, 8, 9, 4, 5, 6}));
        Json& accessor = builder.json["accessors"][0];
        accessor["sparse"] = {{"count", 2},
                              {"indices", {{"bufferView", targets}, {"componentType", kUnsignedShort}}},
                              {"values", {{"bufferView", values}}}};
        if (!hasView) accessor.erase("bufferView");
        const Mesh mesh = builder.import().meshes.at(0);
        EXPECT_EQ(mesh.positionsOS[0], glm::vec3(0));
        EXPECT_EQ(mesh.positionsOS[1], glm::vec3(7, 8, 9));
        EXPECT_EQ(mesh.positionsOS[2], glm::vec3(4, 5, 6));
    }
}

TEST(GltfGeometry, sparseIndicesWithoutABufferViewAreReadExactly) {
    Builder builder;
    const int targets = builder.addView(bytesOf(std::vector<std::uint8_t>{1, 2}));
    const int values = builder.addView(bytesOf(std::vector<std::uint8_t>{2, 1}));
    builder.primitive()["attributes"]["NORMAL"] = 0;
    builder.json["accessors"].push_back({{"componentType", kUnsignedByte}, {"type", "SCALAR"}, {"count", 3}});
    builder.json["accessors"].back()["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", targets}, {"componentType", kUnsignedByte}}},
        {"values", {{"bufferView", values}}}};
    builder.primitive()["indices"] = 1;
    EXPECT_EQ(builder.import().meshes.at(0).indices, (Indices{0, 2, 1}));
}

TEST(GltfGeometry, nonFinitePositionsAreRefusedByMesh) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Builder builder;
        builder.json["meshes"][0]["name"] = "hull";
        builder.primitive()["attributes"]["POSITION"] =
            builder.add(std::vector<float>{0, 0, 0, 1, bad, 0, 0, 1, 0}, kFloat, "VEC3", 3);
        EXPECT_NE(
            builder.error().find("/meshes/0/primitives/0: vertex 1 of mesh 'hull' has a position that is not finite"),
            std::string::npos);
    }
}

TEST(GltfGeometry, attributesOfDifferentLengthAreRefused) {
    Builder builder;
    builder.primitive()["attributes"]["NORMAL"] = builder.add(std::vector<float>{0, 0, 1, 0, 0, 1}, kFloat, "VEC3", 2);
    EXPECT_NE(builder.error().find(
                  "/attributes/NORMAL: accessor 1 of mesh 'mesh 0' has 2 elements, but there are 3 positions"),
              std::string::npos);
}

TEST(GltfGeometry, attributesOfTheWrongTypeAreRefused) {
    Builder builder;
    builder.primitive()["attributes"]["TEXCOORD_0"] = 0;
    EXPECT_NE(builder.error().find(
                  "/attributes/TEXCOORD_0: accessor 0 of mesh 'mesh 0' has 3 components an element; TEXCOORD_0 "
                  "needs 2"),
              std::string::npos);
    Builder matrix;
    matrix.json["accessors"][0]["type"] = "MAT2";
    EXPECT_NE(matrix.error().find("/accessors/0: is a matrix"), std::string::npos);
}

TEST(GltfGeometry, indexBeyondTheVerticesIsRefused) {
    Builder builder;
    builder.primitive()["indices"] = builder.add(std::vector<std::uint8_t>{0, 1, 3}, kUnsignedByte, "SCALAR", 3);
    EXPECT_NE(builder.error().find("/meshes/0/primitives/0: index 3 of mesh 'mesh 0' is no vertex; there are 3"),
              std::string::npos);
    Builder floats;
    floats.primitive()["indices"] = floats.add(std::vector<float>{0, 1, 2}, kFloat, "SCALAR", 3);
    EXPECT_NE(floats.error().find("/accessors/1: holds indices, so it must be SCALAR of"), std::string::npos);
}
} // namespace
} // namespace tessera::scenes::gltf::test
