#pragma once
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/ImportOptions.h"
#include "scenes/Scene.h"

namespace tessera::scenes {

class LoadLedger;

struct LoadOptions {
    std::optional<int> lights;  ///< built-in scenes generate this many (0 to kMostLights); files keep their first N
    bool defaultLight = true;   ///< light a scene without lights by the studio, unless all materials are unlit
    bool defaultCamera = false; ///< replace the scene's cameras by a supplied one
    /// Replaces the scene's environment, keeping its rotation (layAs()): a built-in environment's name, an image file,
    /// a glTF model, or kNoEnvironment.
    std::optional<std::string> environment;
    /// Replaces Scene::background, linear radiance of at least 0; none: the scene's own.
    std::optional<glm::dvec3> background;
    /// Activates the clips of this name, else the clip of this number, or none (kNoClip). Unset: those named by the
    /// scene's options, else the first of each model.
    std::optional<std::string> clip;
    /// Values for parameters of the scene's hook, applied in order.
    std::vector<HookValue> hookValues;
    ImportOptions import; ///< import options of models
    /// Memory limit for reading files (LoadLedger.h); none: defaultMemoryLimitBytes().
    std::optional<std::uint64_t> memoryLimitBytes;
    /// If set, the names of all files read are appended.
    std::vector<std::string>* files = nullptr;
    bool useAssets = true; ///< let a built-in scene use the models under the folder TESSERA_ASSETS names
    /// Aspect, width over height, into which a supplied camera fits the scene; none: that of the scene's options. The
    /// viewer also adapts the cameras of built-in scenes to it.
    std::optional<double> aspect;
    /// Progress callback, see LoadLedger::reportEnvironment().
    std::function<void(double)> environmentProgress;
    /// Checked before a scene is made or its file imported, and between the checks after, but not while a file is read.
    /// LoadStopped is thrown if a stop is requested.
    std::stop_token stop;
};

inline constexpr std::string_view kNoEnvironment = "none";

/// Thrown when LoadOptions::stop cancels a load.
class LoadStopped : public std::exception {
public:
    const char* what() const noexcept override { return "the load was given up"; }
};

/// Loads `nameOrPath`: a built-in scene's name or a .gltf, .glb, .obj or .json file. The result has passed checkScene()
/// and has at least one camera; a supplied camera is named "default", and Scene::supplied lists all supplied defaults.
/// Throws InputError that names the file and its fault, or the nearest names if the name is unknown.
Scene loadScene(const std::string& nameOrPath, const LoadOptions& options = {});

/// Prefix of built-in scenes and environments where documents name files.
inline constexpr std::string_view kBuiltinPrefix = "builtin:";

/// Loads an environment by name as in LoadOptions::environment, also with kBuiltinPrefix. Built-in ones take precedence
/// over files. Throws InputError that names the file and its fault, or the nearest names.
std::optional<Environment> environmentCalled(const std::string& name, LoadLedger& ledger,
                                             std::vector<std::string>& warnings);

/// A built-in scene: a line of `tessera scenes`.
struct BuiltinScene {
    std::string_view name;
    std::string_view purpose; ///< one line: what it is for
    Scene (*make)(const LoadOptions&, LoadLedger&);
    /// Upper bound of the memory to make it with its default number of lights and without assets. A test checks it.
    std::uint64_t bytes;
    /// Counts with the default number of lights and without assets, for listing without making. A test checks them.
    std::size_t triangles, lights, materials;
};
std::span<const BuiltinScene> builtinScenes();
/// The built-in scene of a name, which takes precedence over a file of that name; null if there is none.
const BuiltinScene* builtinScene(std::string_view name);
/// Makes a built-in scene after charging the ledger; `who` names the requester in errors.
Scene makeBuiltin(const BuiltinScene& builtin, const LoadOptions& options, LoadLedger& ledger, const std::string& who);

} // namespace tessera::scenes
