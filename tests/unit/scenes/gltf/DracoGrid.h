#pragma once
#include <array>
#include <memory>
#include <type_traits>
#include <utility>

#include <draco/compression/encode.h>
#include <gtest/gtest.h>

#include "DracoStream.h"

namespace tessera::scenes::gltf::test {

inline constexpr std::size_t kGridSide = 6, kGridVertices = kGridSide * kGridSide; ///< of the grid

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
                const float u = float(x) / (kGridSide - 1), v = float(y) / (kGridSide - 1);
                add(positions, 5.0f * u, 5.0f * v, 0.25f * float(x * y % 3));
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

    /// A document of the uncompressed grid, on a skin of two joints.
    Builder document() const {
        Builder builder;
        builder.merge(R"({"nodes": [{"mesh": 0, "skin": 0}, {}, {}], "scenes": [{"nodes": [0, 1, 2]}],
                          "skins": [{"joints": [1, 2]}]})");
        builder.json["meshes"][0]["name"] = "grid";
        Json& named = builder.primitive()["attributes"] = Json::object();
        for (const Attribute& attribute : attributes)
            named[attribute.name] =
                builder.addAccessor(builder.addView(attribute.bytes), attribute.componentType,
                                    std::array{"", "SCALAR", "VEC2", "VEC3", "VEC4"}[attribute.components],
                                    kGridVertices, attribute.normalized);
        builder.indices(corners);
        return builder;
    }

    std::unique_ptr<draco::Mesh> mesh() const {
        auto mesh = std::make_unique<draco::Mesh>();
        mesh->set_num_points(kGridVertices);
        for (const Attribute& attribute : attributes) {
            const std::size_t bytesEach = attribute.bytes.size() / kGridVertices;
            draco::GeometryAttribute layout;
            layout.Init(attribute.kind, nullptr, std::uint8_t(attribute.components), attribute.type,
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

    /// Identifiers of the attributes by name, in the order of mesh().
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
    /// A stream that keeps all bits of all values, and the order of vertices and triangles.
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

/// A grid's document with a stream in place of the data of all accessors.
inline Builder compressed(const Grid& grid, const Bytes& stream) {
    Builder builder = grid.document();
    for (const auto& [name, accessor] : builder.primitive()["attributes"].items())
        builder.json["accessors"][accessor.get<std::size_t>()].erase("bufferView");
    builder.json["accessors"][builder.primitive()["indices"].get<std::size_t>()].erase("bufferView");
    addDraco(builder, stream, grid.identifiers());
    return builder;
}

/// Replaces the stream of a document that compressed() made.
inline void setStream(Builder& builder, const Bytes& stream) {
    builder.json["buffers"].back() = {{"uri", dataUri(stream)}, {"byteLength", stream.size()}};
    builder.json["bufferViews"].back()["byteLength"] = stream.size();
}

} // namespace tessera::scenes::gltf::test
