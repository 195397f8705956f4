#pragma once
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/ImportWishes.h"
#include "scenes/Scene.h"

namespace tessera::scenes {

class LoadLedger;

struct LoadOptions {
    std::optional<int> lights;  ///< built-in scenes generate this many (0 to kMostLights); files keep their first N
    bool defaultLight = true;   ///< light a scene without lights by the studio, unless all is unlit
    bool defaultCamera = false; ///< supply a camera even where the scene has its own, which are left out
    /// Takes the place of the scene's own, and its turn (layAs()): a built-in one's name, a picture file, or
    /// kNoEnvironment.
    std::optional<std::string> environment;
    /// Takes the place of Scene::background, linear radiance from 0 on; none: the scene's own.
    std::optional<glm::dvec3> background;
    /// Plays the clips of this name, else the one of this number, or none (kNoClip); without it those that the scene's
    /// options call so, else the first of each model.
    std::optional<std::string> clip;
    /// Given to parameters of the scene's hook, in order.
    std::vector<HookValue> hookValues;
    ImportWishes import; ///< how models are read
    /// The memory that reading files may take (LoadLedger.h); none: half of the machine's.
    std::optional<std::uint64_t> memoryLimitBytes;
    /// Where it is given, the names of the files that are read are added to it.
    std::vector<std::string>* files = nullptr;
    bool useAssets = true; ///< let a built-in scene use the models under the folder TESSERA_ASSETS names
    /// Width over height of the picture that a supplied camera is to fit the scene into; none: what the scene asks for.
    /// The viewer places cameras of built-in scenes by it too.
    std::optional<double> aspect;
    /// That of LoadLedger::tellEnvironment().
    std::function<void(double)> environmentTold;
    /// Asked before a scene is made or its file imported, and between the checks after; while a file is read it is not.
    /// Where a stop is requested, LoadStopped is thrown.
    std::stop_token stop;
};

inline constexpr std::string_view kNoEnvironment = "none";

/// A load was given up, as its LoadOptions asked.
class LoadStopped : public std::exception {
public:
    const char* what() const noexcept override { return "the load was given up"; }
};

/// Loads `nameOrPath`: a built-in scene's name or a .gltf, .glb, .obj or .json file. The result has passed checkScene()
/// and has at least one camera; a supplied default camera or light is named "default" and reported in `warnings`.
/// Throws InputError that names the file and its fault, or the nearest names if the name is unknown.
Scene loadScene(const std::string& nameOrPath, const LoadOptions& options = {});

/// Begins the name of a built-in scene or environment where documents name files.
inline constexpr std::string_view kBuiltinPrefix = "builtin:";

/// The environment of a name as LoadOptions::environment has it; a built-in one goes before a file of its name, and
/// scene files' names of those count too. Throws InputError that names the file and its fault, or the nearest names.
std::optional<Environment> environmentCalled(const std::string& name, LoadLedger& ledger,
                                             std::vector<std::string>& warnings);

/// A built-in scene, a line of `tessera scenes`.
struct BuiltinScene {
    std::string_view name;
    std::string_view purpose; ///< one line: what it is for
    Scene (*make)(const LoadOptions&, LoadLedger&);
    /// Upper bound of the memory to make it with its default number of lights and without assets. A test checks it.
    std::uint64_t bytes;
};
std::span<const BuiltinScene> builtinScenes();
/// The built-in scene of a name, which goes before a file of that name; null where there is none.
const BuiltinScene* builtinScene(std::string_view name);
/// Makes it. The ledger is charged before; `who` names the requester in errors.
Scene makeBuiltin(const BuiltinScene& builtin, const LoadOptions& options, LoadLedger& ledger, const std::string& who);

} // namespace tessera::scenes
