#pragma once
#include <string>
#include <string_view>

#include "scenes/import/Importers.h"
#include "tests/unit/scenes/TempFolder.h"

namespace tessera::scenes::test {

/// True when the shipped JSON Schema accepts the document.
bool schemaAccepts(std::string_view document);

/// A folder with the files that the tests' scenes refer to: models/bust.obj (node "bust", material "default"),
/// parts/lamps.json (a light, a camera, a node "lamp"), hooks/redden.glsl, which changes nothing, and pictures of one
/// texel: albedo 10 20 30, specular 40 50 60, normal 128 128 255.
class SceneFolder : public TempFolder {
public:
    SceneFolder();

    /// Imports scene.json with the given text, which must pass the importer, checkScene() and the schema.
    Scene import(std::string_view text) const;
    /// The same of {"tessera": 1, include bust.obj, MEMBERS}.
    Scene importMembers(const std::string& members) const;

    /// The error of importing the text, after "...scene.json:"; the schema must refuse it too.
    std::string errorOf(std::string_view text) const;
    std::string errorOfMembers(const std::string& members) const;
    /// The same for faults that a schema cannot find: the schema must accept them.
    std::string errorBeyondSchemaOf(std::string_view text) const;
    std::string errorBeyondSchemaOfMembers(const std::string& members) const;

private:
    std::string importError(std::string_view text) const;
};

/// The results of `element` for 0, 1, 2 ... below `count`, with commas between.
template <typename Element>
std::string listOf(int count, Element element) {
    std::string list;
    for (int i = 0; i < count; ++i) list += (i > 0 ? "," : "") + element(i);
    return list;
}

} // namespace tessera::scenes::test
