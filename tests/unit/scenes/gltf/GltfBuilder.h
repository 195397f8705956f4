#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/Error.h"
#include "scenes/import/Importers.h"
#include "tests/support/UnderLedger.h"

/// Small glTF documents for the importer's tests.
namespace tessera::scenes::gltf::test {

using Json = nlohmann::json;
using Bytes = std::vector<std::byte>;

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

/// A 2x1 PNG, red and half-transparent blue, RGBA 8 bit.
Bytes pngRedBlue();

/// A folder of the running test's own, removed with this object.
class Folder {
public:
    Folder() {
        static int made = 0; // tests run one after the other
        path_ = std::filesystem::temp_directory_path() /
                ("tessera-test-" + std::to_string(::getpid()) + "-" + std::to_string(++made));
        std::filesystem::create_directories(path_);
    }
    Folder(Folder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
    Folder& operator=(Folder&&) = delete;
    ~Folder() {
        if (!path_.empty()) std::filesystem::remove_all(path_);
    }

    std::filesystem::path write(const std::string& name, const Bytes& bytes) const {
        const std::filesystem::path file = path_ / std::filesystem::path(std::u8string(name.begin(), name.end()));
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        return file;
    }
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        return write(name, bytesOf(std::vector<char>(text.begin(), text.end())));
    }

private:
    std::filesystem::path path_;
};

/// One triangle (0,0,0) (1,0,0) (0,1,0) at node 0 of scene 0: accessor 0 is POSITION, in buffer view 0 of buffer 0.
/// Tests change `json`.
class Builder {
public:
    Builder() {
        json =
            Json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                               "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]})");
        add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3);
    }

    /// A buffer with one view of all its bytes; returns the view's number.
    int addView(const Bytes& bytes, int byteStride = 0) {
        json["buffers"].push_back({{"uri", dataUri(bytes)}, {"byteLength", bytes.size()}});
        json["bufferViews"].push_back({{"buffer", json["buffers"].size() - 1}, {"byteLength", bytes.size()}});
        if (byteStride > 0) json["bufferViews"].back()["byteStride"] = byteStride;
        return static_cast<int>(json["bufferViews"].size()) - 1;
    }

    /// An accessor in a buffer of its own; returns its number.
    template <typename T>
    int add(const std::vector<T>& values, int componentType, const char* type, std::size_t count,
            bool normalized = false, int byteStride = 0) {
        const int view = addView(bytesOf(values), byteStride);
        json["accessors"].push_back(
            {{"bufferView", view}, {"componentType", componentType}, {"type", type}, {"count", count}});
        if (normalized) json["accessors"].back()["normalized"] = true;
        return static_cast<int>(json["accessors"].size()) - 1;
    }

    Json& primitive() { return json["meshes"][0]["primitives"][0]; }

    /// Gives the triangle a material and returns its JSON.
    Json& material() {
        json["materials"] = Json::parse(R"([{"name": "paint"}])");
        primitive()["material"] = 0;
        return json["materials"][0];
    }

    /// Adds texture 0 of an embedded picture, and texture coordinates.
    void addTexture(const Bytes& picture = pngRedBlue()) {
        Json& attributes = primitive()["attributes"];
        if (!attributes.contains("TEXCOORD_0"))
            attributes["TEXCOORD_0"] = attributes["TEXCOORD_1"] =
                add(std::vector<float>{0, 0, 1, 0, 0, 1}, 5126, "VEC2", 3);
        json["images"] = Json::array({Json::object({{"uri", "data:image/png;base64," + base64(picture)}})});
        json["textures"] = Json::parse(R"([{"source": 0}])");
    }

    Scene import() const { return underLedger(importGltf, folder.write("model.gltf", json.dump()), {}, wishes); }

    /// What a strict import refuses the document with, or "" when it does not.
    std::string error(std::optional<std::uint64_t> limitBytes = {}) const {
        return errorOf(folder.write("model.gltf", json.dump()), wishes, limitBytes);
    }
    static std::string errorOf(const std::filesystem::path& file, ImportWishes asked = {},
                               std::optional<std::uint64_t> limitBytes = {}) {
        asked.isStrict = true;
        try {
            underLedger(importGltf, file, limitBytes, asked);
        } catch (const InputError& error) {
            expectTold(error.what(), file, asked, limitBytes);
            return error.what();
        }
        return "";
    }

    /// An import that is not strict warns of the same, or refuses it too.
    static void expectTold(const std::string& flaw, const std::filesystem::path& file, ImportWishes asked,
                           std::optional<std::uint64_t> limitBytes) {
        asked.isStrict = false;
        try {
            const Scene scene = underLedger(importGltf, file, limitBytes, asked);
            EXPECT_THAT(scene.warnings, testing::Contains(testing::StartsWith(flaw)));
        } catch (const InputError& error) {
            EXPECT_EQ(error.what(), flaw);
        }
    }

    void merge(const char* patch) { json.merge_patch(Json::parse(patch)); }

    Json json;
    ImportWishes wishes;
    Folder folder;
};

/// The triangle with a material to which a patch adds. The patch may use texture 0.
inline Builder withMaterial(const char* patch) {
    Builder builder;
    builder.material().merge_patch(Json::parse(patch));
    builder.addTexture();
    return builder;
}

/// That material as it is imported.
inline Material importedMaterial(const char* patch) {
    const Scene scene = withMaterial(patch).import();
    return scene.materials.at(static_cast<std::size_t>(scene.nodes.at(0).instances.at(0).material));
}

inline bool hasWarning(const Scene& scene, const std::string& part) {
    for (const std::string& warning : scene.warnings)
        if (warning.find(part) != std::string::npos) return true;
    return false;
}

} // namespace tessera::scenes::gltf::test
