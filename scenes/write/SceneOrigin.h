#pragma once
#include <filesystem>
#include <map>

#include "scenes/Load.h"

namespace tessera::scenes {

/// A scene's file and original contents, which a file of later edits refers to.
struct SceneOrigin {
    std::string base;                   ///< absolute path of a scene file, or builtin:NAME
    std::optional<int> lights;          ///< requested number of lights of a built-in scene
    bool useAssets = true;              ///< whether it may use the models of TESSERA_ASSETS
    std::optional<std::string> variant; ///< requested variant of models, by a command or a file above the base
    /// Materials replaced by .json files between the base and the scene, as JSON by index. Further edits do not need
    /// these files.
    std::map<std::size_t, std::string> replacedMaterials;
    std::vector<std::filesystem::path> documents; ///< .json files of the base; they must not be overwritten
    std::vector<Material> materials;              ///< as loaded, with rest values
    std::size_t images = 0, meshes = 0, nodes = 0;
};

/// The origin of a scene that loadScene() has just loaded with these arguments. Rereads its documents one at a time,
/// with a ledger that starts with the scene's memory. Throws InputError if one is now unreadable or too large.
SceneOrigin originOf(const std::string& nameOrPath, const LoadOptions& options, const Scene& loaded);

} // namespace tessera::scenes
