#pragma once
#include <filesystem>
#include <map>

#include "scenes/Load.h"

namespace tessera::scenes {

/// The file of a scene and its original contents, to which a file that holds only later edits refers.
struct SceneOrigin {
    std::string base;                   ///< absolute path of a scene file, or builtin:NAME
    std::optional<int> lights;          ///< that a built-in scene was asked to make
    bool useAssets = true;              ///< whether it may use the models of TESSERA_ASSETS
    std::optional<std::string> variant; ///< of models that was asked for, by a command or a file above the base
    /// Materials that .json files between the base and the scene replace, as JSON by index. Such files need not exist
    /// any more for what is edited further.
    std::map<std::size_t, std::string> replacedMaterials;
    std::vector<std::filesystem::path> documents; ///< .json files that the base is made of: not to be written over
    std::vector<Material> materials;              ///< as they were loaded, at rest
    std::size_t images = 0, meshes = 0, nodes = 0;
};

/// The origin of a scene that loadScene() has just made of these. Reads its documents again, one at a time, under a
/// ledger that begins with what the scene takes. Throws InputError where a file has changed since in a way that cannot
/// be read, or that takes too much.
SceneOrigin originOf(const std::string& nameOrPath, const LoadOptions& options, const Scene& loaded);

} // namespace tessera::scenes
