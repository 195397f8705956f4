#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "scenes/import/Importers.h"
#include "tests/unit/scenes/TempFolder.h"

namespace tessera::scenes::test {

/// Returns whether the shipped JSON Schema accepts the document.
bool schemaAccepts(std::string_view document);

/// A glTF model of a triangle of the material paint, or ruby in the variant 'red'.
inline constexpr const char* kCar = R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
    "extensions": {"KHR_materials_variants": {"variants": [{"name": "red"}]}},
    "materials": [{"name": "paint"}, {"name": "ruby"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0, "extensions": {"KHR_materials_variants":
        {"mappings": [{"material": 1, "variants": [0]}]}}}]}],
    "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3}]})";

/// A folder with the files that the tests' scenes refer to: models/bust.obj (node "bust", material "default"),
/// parts/lamps.json (a light, a camera, a node "lamp"), hooks/redden.glsl, which changes nothing, and images of one
/// texel: albedo 10 20 30, specular 40 50 60, normal 128 128 255.
class SceneFolder : public TempFolder {
public:
    SceneFolder();

    /// Imports scene.json with the given text, which must pass the importer, checkScene() and the schema.
    Scene import(std::string_view text) const;
    /// Same, for {"tessera": 1, include bust.obj, MEMBERS}.
    Scene importMembers(const std::string& members) const;

    /// The error of importing the text, after "...scene.json:"; the schema must refuse it too.
    std::string errorOf(std::string_view text) const;
    std::string errorOfMembers(const std::string& members) const;
    /// Same, for faults that a schema cannot detect: the schema must accept them.
    std::string errorBeyondSchemaOf(std::string_view text) const;
    std::string errorBeyondSchemaOfMembers(const std::string& members) const;

private:
    std::string importError(std::string_view text) const;
};

/// Expects equality up to the rounding of sine and cosine.
inline void expectNear(const glm::dvec3& a, const glm::dvec3& b) {
    EXPECT_LT(glm::distance(a, b), 1e-12) << a.x << ' ' << a.y << ' ' << a.z;
}

/// Tests of scene files, with a folder for them.
class SceneFiles : public testing::Test {
protected:
    const SceneFolder folder;
};

/// Tests of an element in a list of scene files, such as "lights". Errors start after the element's path.
class OneElement : public SceneFiles {
protected:
    explicit OneElement(std::string list) : list_(std::move(list)) {}
    std::string document(const std::string& element) const {
        return R"({"tessera": 1, ")" + list_ + R"(": [)" + element + "]}";
    }
    Scene import(const std::string& element) const { return folder.import(document(element)); }
    std::string errorOf(const std::string& element) const { return inElement(folder.errorOf(document(element))); }
    std::string errorBeyondSchemaOf(const std::string& element) const {
        return inElement(folder.errorBeyondSchemaOf(document(element)));
    }
    /// Removes the element's path from an error, also of larger documents.
    std::string inElement(const std::string& error) const {
        const std::string place = "/" + list_ + "/0";
        EXPECT_THAT(error, testing::StartsWith(place));
        return error.substr(std::min(error.size(), place.size()));
    }

private:
    std::string list_;
};

/// Joins the results of `element` for 0 to `count` - 1 with commas.
template <typename Element>
std::string listOf(int count, Element element) {
    std::string list;
    for (int i = 0; i < count; ++i) list += (i > 0 ? "," : "") + element(i);
    return list;
}

} // namespace tessera::scenes::test
