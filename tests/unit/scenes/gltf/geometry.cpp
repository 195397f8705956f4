#include <cmath>
#include <limits>

#include "GltfBuilder.h"

namespace tessera::scenes::gltf::test {
namespace {

constexpr int kUnsignedByte = 5121, kFloat = 5126;

using Indices = std::vector<std::uint32_t>;

/// Five points of a fan or strip in the plane z = 0.
Builder withFivePoints(int mode) {
    Builder builder;
    builder.attribute("POSITION", "VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
    builder.attribute("NORMAL", "VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
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

TEST(GltfGeometry, stripsKeepTheirWindingAndFansTurnAboutTheirFirstPoint) {
    EXPECT_EQ(withFivePoints(5).import().meshes.at(0).indices, (Indices{0, 1, 2, 1, 3, 2, 2, 3, 4}));
    EXPECT_EQ(withFivePoints(6).import().meshes.at(0).indices, (Indices{1, 2, 0, 2, 3, 0, 3, 4, 0}));
}

TEST(GltfGeometry, stripNeverYieldsTrianglesThatNameACornerTwice) {
    Builder builder = withFivePoints(5);
    builder.indices({0, 1, 2, 2, 3, 4});
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
    const auto readOf = [](auto corners) {
        Builder builder;
        builder.primitive()["attributes"]["NORMAL"] = 0;
        builder.indices(corners);
        return builder.import().meshes.at(0).indices;
    };
    EXPECT_EQ(readOf(std::vector<std::uint8_t>{2, 0, 1}), (Indices{2, 0, 1}));
    EXPECT_EQ(readOf(std::vector<std::uint16_t>{2, 0, 1}), (Indices{2, 0, 1}));
    EXPECT_EQ(readOf(Indices{2, 0, 1}), (Indices{2, 0, 1}));
}

TEST(GltfGeometry, missingNormalsAreFlatWithUnsharedVertices) {
    Builder builder;
    builder.attribute("POSITION", "VEC3", {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2});
    builder.attribute("TANGENT", "VEC4", std::vector<float>(16, 1.0f));
    builder.indices({0, 1, 2, 0, 2, 3});
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
    builder.attribute("NORMAL", "VEC3", {0, 0, 5, 0, 3, 4, 0, 0, 0});
    builder.attribute("TANGENT", "VEC4", {2, 0, 0, -0.5f, 1, 0, 0, 1, 0, 9, 0, 1});
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
    builder.attribute("NORMAL", "VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1});
    builder.attribute("TANGENT", "VEC4", std::vector<float>(12, 0.0f));
    const Scene scene = builder.import();
    EXPECT_TRUE(scene.meshes.at(0).tangentsOS.empty());
    EXPECT_TRUE(hasWarning(scene, "tangents without a direction"));
}

TEST(GltfGeometry, bothTexCoordSetsAreImportedExactly) {
    Builder builder;
    builder.attribute("TEXCOORD_0", "VEC2", {0, 1, 2, 3, 4, 5});
    builder.attribute<std::uint8_t>("TEXCOORD_1", "VEC2", {0, 255, 51, 0, 0, 0, 255, 255, 0, 0, 0, 0}, true, 4);
    builder.primitive()["attributes"]["TEXCOORD_2"] = 1;
    const Scene scene = builder.import();
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.texCoords[0][2], glm::vec2(4, 5));
    EXPECT_EQ(mesh.texCoords[1][0], glm::vec2(0, 1));
    EXPECT_EQ(mesh.texCoords[1][1], glm::vec2(0, 0)) << "elements are byteStride 4 apart";
    EXPECT_TRUE(hasWarning(scene, "TEXCOORD_2 is left out"));
}

TEST(GltfGeometry, vertexColorOfEveryFormBecomesLinearRgba) {
    const auto colorsOf = [](const auto& values, const char* type, bool isNormalized) {
        Builder builder;
        builder.attribute("COLOR_0", type, values, isNormalized);
        return builder.import();
    };
    const auto first = [](const Scene& scene) { return scene.meshes.at(0).colors.at(0); };
    EXPECT_EQ(first(colorsOf(std::vector<float>{.25f, .5f, 1, 0, 0, 0, 0, 0, 0}, "VEC3", false)),
              glm::vec4(.25f, .5f, 1, 1));
    EXPECT_EQ(first(colorsOf(std::vector<std::uint16_t>{65535, 0, 13107, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4", true)),
              glm::vec4(1, 0, .2f, 0));
    EXPECT_EQ(first(colorsOf(std::vector<float>{-5, 50, .5f, 2, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4", false)),
              glm::vec4(0, 1, .5f, 1))
        << "clamped";
    const Scene unmarked = colorsOf(std::vector<std::uint8_t>(12, 51), "VEC4", false);
    EXPECT_EQ(unmarked.meshes.at(0).colors.at(2), glm::vec4(.2f));
    EXPECT_TRUE(hasWarning(unmarked, "COLOR_0: holds integers that are not marked normalized"));
}

TEST(GltfGeometry, quantizedAttributesAreConvertedExactly) {
    Builder builder;
    builder.merge(R"({"extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"]})");
    builder.attribute<std::int16_t>("POSITION", "VEC3", {-300, 0, 0, 0, 300, 0, 0, 0, 0, 300, 0, 0}, false, 8);
    builder.attribute<std::int8_t>("NORMAL", "VEC3", {0, 0, 127, 0, 0, 0, -128, 0, 127, 0, 0, 0}, true, 4);
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
        builder.makeSparse<std::uint16_t>(0, {1, 2}, {7, 8, 9, 4, 5, 6});
        if (!hasView) builder.json["accessors"][0].erase("bufferView");
        const Mesh mesh = builder.import().meshes.at(0);
        EXPECT_EQ(mesh.positionsOS[0], glm::vec3(0));
        EXPECT_EQ(mesh.positionsOS[1], glm::vec3(7, 8, 9));
        EXPECT_EQ(mesh.positionsOS[2], glm::vec3(4, 5, 6));
    }
}

TEST(GltfGeometry, sparseIndicesWithoutABufferViewAreReadExactly) {
    Builder builder;
    builder.primitive()["attributes"]["NORMAL"] = 0;
    builder.json["accessors"].push_back({{"componentType", kUnsignedByte}, {"type", "SCALAR"}, {"count", 3}});
    builder.makeSparse<std::uint8_t, std::uint8_t>(1, {1, 2}, {2, 1});
    builder.primitive()["indices"] = 1;
    EXPECT_EQ(builder.import().meshes.at(0).indices, (Indices{0, 2, 1}));
}

TEST(GltfGeometry, nonFinitePositionsAreRefusedByMesh) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Builder builder;
        builder.json["meshes"][0]["name"] = "hull";
        builder.attribute("POSITION", "VEC3", {0, 0, 0, 1, bad, 0, 0, 1, 0});
        EXPECT_THAT(builder.error(),
                    HasSubstr("/meshes/0/primitives/0: vertex 1 of mesh 'hull' has a position that is not finite"));
    }
}

TEST(GltfGeometry, attributesAndIndicesThatDoNotFitAreRefused) {
    const auto errorWith = [](auto change) {
        Builder builder;
        change(builder);
        return builder.error();
    };
    EXPECT_THAT(errorWith([](Builder& b) {
                    b.attribute("NORMAL", "VEC3", {0, 0, 1, 0, 0, 1});
                }),
                HasSubstr("/attributes/NORMAL: accessor 1 of mesh 'mesh 0' has 2 elements, but there are 3 positions"));
    EXPECT_THAT(errorWith([](Builder& b) { b.primitive()["attributes"]["TEXCOORD_0"] = 0; }),
                HasSubstr("/attributes/TEXCOORD_0: accessor 0 of mesh 'mesh 0' has 3 components an element; TEXCOORD_0 "
                          "needs 2"));
    EXPECT_THAT(errorWith([](Builder& b) { b.json["accessors"][0]["type"] = "MAT2"; }),
                HasSubstr("/accessors/0: is a matrix"));
    EXPECT_THAT(errorWith([](Builder& b) {
                    b.indices({0, 1, 3});
                }),
                HasSubstr("/meshes/0/primitives/0: index 3 of mesh 'mesh 0' is no vertex; there are 3"));
    EXPECT_THAT(errorWith([](Builder& b) {
                    b.indices<float>({0, 1, 2});
                }),
                HasSubstr("/accessors/1: holds indices, so it must be SCALAR of"));
}

} // namespace
} // namespace tessera::scenes::gltf::test
