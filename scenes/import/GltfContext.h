#pragma once
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "scenes/Scene.h"
#include "scenes/import/GltfAccessors.h"

namespace tessera::scenes::gltf {

/// What every part of one import works on.
struct Context {
    const Document& document;
    Buffers& buffers;
    Accessors& accessors;
    Scene& scene;
    std::unordered_set<std::string> warned = {};             ///< the scene's warnings
    std::unordered_map<std::string, int> cameraNumbers = {}; ///< the last number behind a name that was taken
    std::unordered_set<std::string> cameraNames = {};

    /// Adds "file: text" to the scene's warnings unless it already stands there.
    void warn(const std::string& text) {
        std::string line = fmt::format("{}: {}", document.file, text);
        if (warned.insert(line).second) scene.warnings.push_back(std::move(line));
    }
};

/// `name` as the document gives it, else "`kind` `index`".
inline std::string nameOr(const std::string& name, const char* kind, int index) {
    return name.empty() ? fmt::format("{} {}", kind, index) : name;
}

} // namespace tessera::scenes::gltf
