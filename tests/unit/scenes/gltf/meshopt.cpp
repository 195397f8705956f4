#include <meshoptimizer.h>

#include "GltfBuilder.h"

namespace tessera::scenes::gltf::test {
namespace {

/// Adds a buffer view whose data is `encoded`; the fallback buffer has no data of its own.
int addCompressed(Builder& builder, const Bytes& encoded, std::size_t count, std::size_t byteStride, const char* mode,
                  const char* filter = nullptr) {
    builder.merge(
        R"({"extensionsUsed": ["EXT_meshopt_compression"], "extensionsRequired": ["EXT_meshopt_compression"]})");
    Json& buffers = builder.json["buffers"];
    buffers.push_back({{"uri", dataUri(encoded)}, {"byteLength", encoded.size()}});
    const std::size_t source = buffers.size() - 1;
    buffers.push_back(
        {{"byteLength", count * byteStride}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    Json view = {{"buffer", buffers.size() - 1}, {"byteLength", count * byteStride}};
    if (std::string(mode) == "ATTRIBUTES") view["byteStride"] = byteStride;
    view["extensions"]["EXT_meshopt_compression"] = {{"buffer", source},
                                                     {"byteLength", encoded.size()},
                                                     {"byteStride", byteStride},
                                                     {"count", count},
                                                     {"mode", mode}};
    if (filter != nullptr) view["extensions"]["EXT_meshopt_compression"]["filter"] = filter;
    builder.json["bufferViews"].push_back(view);
    return int(builder.json["bufferViews"].size()) - 1;
}

template <typename T>
Bytes encodedVertices(const std::vector<T>& vertices, std::size_t byteStride) {
    const std::size_t count = vertices.size() * sizeof(T) / byteStride;
    std::vector<unsigned char> encoded(meshopt_encodeVertexBufferBound(count, byteStride));
    encoded.resize(meshopt_encodeVertexBuffer(encoded.data(), encoded.size(), vertices.data(), count, byteStride));
    return bytesOf(encoded);
}

const std::vector<float> kCorners = {0, 0, 0, 2, 0, 0, 0, 2, 0};

TEST(GltfMeshopt, attributesAreDecodedExactly) {
    Builder builder;
    const int view = addCompressed(builder, encodedVertices(kCorners, 12), 3, 12, "ATTRIBUTES");
    builder.primitive()["attributes"]["POSITION"] = builder.addAccessor(view, 5126, "VEC3", 3);
    EXPECT_EQ(builder.import().meshes.at(0).positionsOS.at(1), glm::vec3(2, 0, 0));
}

TEST(GltfMeshopt, trianglesAndIndicesAreDecodedExactly) {
    const std::vector<unsigned> corners = {0, 1, 2, 2, 1, 3};
    Builder builder;
    builder.attribute("POSITION", "VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    builder.attribute("NORMAL", "VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    std::vector<unsigned char> triangles(meshopt_encodeIndexBufferBound(6, 4));
    triangles.resize(meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), corners.data(), 6));
    std::vector<unsigned char> sequence(meshopt_encodeIndexSequenceBound(6, 4));
    sequence.resize(meshopt_encodeIndexSequence(sequence.data(), sequence.size(), corners.data(), 6));

    builder.primitive()["indices"] =
        builder.addAccessor(addCompressed(builder, bytesOf(sequence), 6, 4, "INDICES"), 5125, "SCALAR", 6);
    EXPECT_EQ(builder.import().meshes.at(0).indices, corners);
    builder.primitive()["indices"] =
        builder.addAccessor(addCompressed(builder, bytesOf(triangles), 6, 2, "TRIANGLES"), 5123, "SCALAR", 6);
    const std::vector<std::uint32_t> decoded = builder.import().meshes.at(0).indices;
    ASSERT_EQ(decoded.size(), 6u);
    // The codec may rotate a triangle's corners, so the smallest index of each is moved to the front.
    for (std::size_t t = 0; t < 6; t += 3) {
        std::vector<std::uint32_t> triangle(decoded.begin() + std::ptrdiff_t(t),
                                            decoded.begin() + std::ptrdiff_t(t + 3));
        while (triangle[0] > triangle[1] || triangle[0] > triangle[2])
            std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
        EXPECT_EQ(triangle, (t == 0 ? std::vector<std::uint32_t>{0, 1, 2} : std::vector<std::uint32_t>{1, 3, 2}));
    }
}

TEST(GltfMeshopt, octahedralFilterIsUndone) {
    const std::vector<float> normals = {0, 0, 1, 0, 0, 0.6f, 0.8f, 0, -1, 0, 0, 0};
    std::vector<std::int16_t> filtered(12);
    meshopt_encodeFilterOct(filtered.data(), 3, 8, 16, normals.data());
    Builder builder;
    const int view = addCompressed(builder, encodedVertices(filtered, 8), 3, 8, "ATTRIBUTES", "OCTAHEDRAL");
    builder.primitive()["attributes"]["NORMAL"] = builder.addAccessor(view, 5122, "VEC3", 3, true);
    const Mesh mesh = builder.import().meshes.at(0);
    // 16-bit octahedral coordinates are 3e-5 apart.
    EXPECT_LT(glm::length(mesh.normalsOS.at(1) - glm::vec3(0, 0.6f, 0.8f)), 1e-4f);
    EXPECT_LT(glm::length(mesh.normalsOS.at(2) - glm::vec3(-1, 0, 0)), 1e-4f);
}

TEST(GltfMeshopt, exponentialFilterIsUndone) {
    std::vector<std::uint32_t> filtered(9);
    meshopt_encodeFilterExp(filtered.data(), 3, 12, 20, kCorners.data());
    Builder builder;
    const int view = addCompressed(builder, encodedVertices(filtered, 12), 3, 12, "ATTRIBUTES", "EXPONENTIAL");
    builder.primitive()["attributes"]["POSITION"] = builder.addAccessor(view, 5126, "VEC3", 3);
    EXPECT_EQ(builder.import().meshes.at(0).positionsOS.at(2), glm::vec3(0, 2, 0));
}

TEST(GltfMeshopt, quaternionFilterIsUndone) {
    const std::vector<float> rotations = {0, 0, 0, 1, 0.5f, 0.5f, 0.5f, 0.5f, 0, 1, 0, 0};
    std::vector<std::int16_t> filtered(12);
    meshopt_encodeFilterQuat(filtered.data(), 3, 8, 12, rotations.data());
    Builder builder;
    const int view = addCompressed(builder, encodedVertices(filtered, 8), 3, 8, "ATTRIBUTES", "QUATERNION");
    builder.primitive()["attributes"]["COLOR_0"] = builder.addAccessor(view, 5122, "VEC4", 3, true);
    const Mesh mesh = builder.import().meshes.at(0);
    // 12-bit components over +-1/sqrt(2) are 3.5e-4 apart.
    EXPECT_LT(glm::length(mesh.colors.at(1) - glm::vec4(0.5f)), 1e-3f);
}

TEST(GltfMeshopt, brokenDataIsRefused) {
    const Bytes good = encodedVertices(kCorners, 12);
    const auto errorOf = [](const Bytes& bytes, std::size_t count, std::size_t stride, const char* mode,
                            const char* filter = nullptr) {
        Builder builder;
        const int view = addCompressed(builder, bytes, count, stride, mode, filter);
        if (stride > 252 || stride % 4 != 0) builder.json["bufferViews"].back().erase("byteStride");
        builder.primitive()["attributes"]["POSITION"] = builder.addAccessor(view, 5126, "VEC3", 3);
        return builder.error();
    };
    EXPECT_EQ(errorOf(good, 3, 12, "ATTRIBUTES"), "");
    for (std::size_t size = 1; size < good.size(); ++size)
        EXPECT_NE(errorOf(Bytes(good.begin(), good.begin() + std::ptrdiff_t(size)), 3, 12, "ATTRIBUTES"), "") << size;
    EXPECT_THAT(errorOf(Bytes(good.size()), 3, 12, "ATTRIBUTES"),
                HasSubstr("/bufferViews/1/extensions/EXT_meshopt_compression: its ATTRIBUTES data is broken"));
    EXPECT_THAT(errorOf(good, 1000000000, 12, "ATTRIBUTES"),
                HasSubstr("bytes cannot hold 1000000000 elements of 12 bytes"));
    EXPECT_THAT(errorOf(good, 3, 6, "ATTRIBUTES"), HasSubstr("needs a byteStride divisible by 4, not 6"));
    EXPECT_THAT(errorOf(good, 3, 8, "TRIANGLES"), HasSubstr("needs a byteStride of 2 or 4, not 8"));
    EXPECT_THAT(errorOf(good, 4, 4, "TRIANGLES"), HasSubstr("needs a count divisible by 3, not 4"));
    EXPECT_THAT(errorOf(good, 3, 4, "INDICES", "OCTAHEDRAL"),
                HasSubstr("filter OCTAHEDRAL works with mode ATTRIBUTES only"));
    EXPECT_THAT(errorOf(good, 3, 12, "ATTRIBUTES", "OCTAHEDRAL"), HasSubstr("needs a byteStride of 4 or 8, not 12"));
    EXPECT_THAT(errorOf(good, 3, 12, "ATTRIBUTES", "QUATERNION"), HasSubstr("needs a byteStride of 8, not 12"));
}

} // namespace
} // namespace tessera::scenes::gltf::test
