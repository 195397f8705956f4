#pragma once
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/Error.h"
#include "scenes/import/Importers.h"
#include "tests/support/TempFolder.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/PictureBytes.h"

/// Small glTF documents for the importer's tests.
namespace tessera::scenes::gltf::test {

using Json = nlohmann::json;
using Bytes = std::vector<std::byte>;
using testing::AllOf, testing::Contains, testing::ElementsAre, testing::HasSubstr, testing::IsEmpty, testing::SizeIs;

template <typename T>
Bytes bytesOf(const std::vector<T>& values) {
    Bytes bytes(values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

inline std::string base64(const Bytes& bytes) {
    static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? std::to_integer<unsigned>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63u];
    }
    return text;
}

inline std::string dataUri(const Bytes& bytes) {
    return "data:application/octet-stream;base64," + base64(bytes);
}

inline Bytes bytesOf(std::string_view text) {
    return bytesOf(std::vector<char>(text.begin(), text.end()));
}

/// A 2x1 PNG, red and half-transparent blue, RGBA 8 bit.
inline Bytes pngRedBlue() {
    return bytesOf(scenes::test::pngOf(2, 1, 8, 6, std::string("\xff\0\0\xff\x0a\x14\xc8\x80", 8)));
}

/// A temporary folder that also takes bytes.
class Folder : public tessera::test::TempFolder {
public:
    using TempFolder::write;
    std::filesystem::path write(const std::string& name, const Bytes& bytes) const {
        return write(name, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    }
};

/// The glTF number of a component type.
template <typename T>
inline constexpr int kComponentType = std::is_floating_point_v<T> ? 5126
                                      : sizeof(T) == 4            ? 5125
                                                       : (sizeof(T) == 1 ? 5120 : 5122) + int(std::is_unsigned_v<T>);

/// One triangle (0,0,0) (1,0,0) (0,1,0) at node 0 of scene 0: accessor 0 is POSITION, in buffer view 0 of buffer 0.
/// Tests change `json`.
class Builder {
public:
    Builder() {
        json =
            Json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                               "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]})");
        add("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    }

    /// Adds a buffer with one view of all its bytes; returns the view's number.
    int addView(const Bytes& bytes, int byteStride = 0) {
        json["buffers"].push_back({{"uri", dataUri(bytes)}, {"byteLength", bytes.size()}});
        json["bufferViews"].push_back({{"buffer", json["buffers"].size() - 1}, {"byteLength", bytes.size()}});
        if (byteStride > 0) json["bufferViews"].back()["byteStride"] = byteStride;
        return int(json["bufferViews"].size()) - 1;
    }

    int addAccessor(int view, int componentType, const char* type, std::size_t count, bool normalized = false) {
        json["accessors"].push_back(
            {{"bufferView", view}, {"componentType", componentType}, {"type", type}, {"count", count}});
        if (normalized) json["accessors"].back()["normalized"] = true;
        return int(json["accessors"].size()) - 1;
    }

    /// Adds an accessor with a buffer of its own; the values determine its count. Returns its number.
    template <typename T = float>
    int add(const char* type, const std::vector<T>& values, bool normalized = false, int byteStride = 0) {
        const std::size_t components = *type == 'S' ? 1 : *type == 'M' ? 16 : std::size_t(type[3] - '0');
        const std::size_t bytesEach = byteStride > 0 ? std::size_t(byteStride) : components * sizeof(T);
        return addAccessor(addView(bytesOf(values), byteStride), kComponentType<T>, type,
                           values.size() * sizeof(T) / bytesEach, normalized);
    }
    /// Same, for an attribute of the primitive.
    template <typename T = float>
    void attribute(const char* name, const char* type, const std::vector<T>& values, bool normalized = false,
                   int byteStride = 0) {
        const int accessor = add(type, values, normalized, byteStride);
        primitive()["attributes"][name] = accessor;
    }
    template <typename T = std::uint8_t>
    void indices(const std::vector<T>& corners) {
        primitive()["indices"] = add("SCALAR", corners);
    }
    /// Replaces elements of an accessor; returns its "sparse".
    template <typename Index, typename Value = float>
    Json& makeSparse(std::size_t accessor, const std::vector<Index>& places, const std::vector<Value>& values) {
        const int indices = addView(bytesOf(places)), replacing = addView(bytesOf(values));
        return json["accessors"][accessor]["sparse"] = {
                   {"count", places.size()},
                   {"indices", {{"bufferView", indices}, {"componentType", kComponentType<Index>}}},
                   {"values", {{"bufferView", replacing}}}};
    }
    /// Gives the primitive a morph target of positions.
    void target(const std::vector<float>& positions) {
        primitive()["targets"] = Json::array({Json::object({{"POSITION", add("VEC3", positions)}})});
    }

    Json& primitive() { return json["meshes"][0]["primitives"][0]; }

    /// Gives the triangle a material and returns its JSON.
    Json& material() {
        json["materials"] = Json::parse(R"([{"name": "paint"}])");
        primitive()["material"] = 0;
        return json["materials"][0];
    }

    /// Adds texture 0 with an embedded image, and texture coordinates.
    void addTexture(const Bytes& picture = pngRedBlue()) {
        Json& attributes = primitive()["attributes"];
        if (!attributes.contains("TEXCOORD_0"))
            attributes["TEXCOORD_0"] = attributes["TEXCOORD_1"] = add("VEC2", {0, 0, 1, 0, 0, 1});
        json["images"] = Json::array({Json::object({{"uri", "data:image/png;base64," + base64(picture)}})});
        json["textures"] = Json::parse(R"([{"source": 0}])");
    }

    Scene import() const { return underLedger(importGltf, folder.write("model.gltf", json.dump()), {}, importOptions); }

    /// Returns the error of a strict import, or "" without one.
    std::string error(std::optional<std::uint64_t> limitBytes = {}) const {
        return errorOf(folder.write("model.gltf", json.dump()), importOptions, limitBytes);
    }
    static std::string errorOf(const std::filesystem::path& file, ImportOptions requested = {},
                               std::optional<std::uint64_t> limitBytes = {}) {
        requested.isStrict = true;
        try {
            underLedger(importGltf, file, limitBytes, requested);
        } catch (const InputError& error) {
            expectReported(error.what(), file, requested, limitBytes);
            return error.what();
        }
        return "";
    }

    /// Expects a lenient import to warn of the flaw or to fail with it.
    static void expectReported(const std::string& flaw, const std::filesystem::path& file, ImportOptions requested,
                               std::optional<std::uint64_t> limitBytes) {
        requested.isStrict = false;
        try {
            const Scene scene = underLedger(importGltf, file, limitBytes, requested);
            EXPECT_THAT(scene.warnings, testing::Contains(testing::StartsWith(flaw)));
        } catch (const InputError& error) {
            EXPECT_EQ(error.what(), flaw);
        }
    }

    void merge(const char* patch) { json.merge_patch(Json::parse(patch)); }

    Json json;
    ImportOptions importOptions;
    Folder folder;
};

/// The triangle with a material that a patch changes. The patch may use texture 0.
inline Builder withMaterial(const char* patch) {
    Builder builder;
    builder.material().merge_patch(Json::parse(patch));
    builder.addTexture();
    return builder;
}

/// Returns that material as imported.
inline Material importedMaterial(const char* patch) {
    const Scene scene = withMaterial(patch).import();
    return scene.materials.at(std::size_t(scene.nodes.at(0).instances.at(0).material));
}

inline bool hasWarning(const Scene& scene, const std::string& part) {
    for (const std::string& warning : scene.warnings)
        if (warning.find(part) != std::string::npos) return true;
    return false;
}

} // namespace tessera::scenes::gltf::test
