#include "scenes/Load.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <string_view>
#include <system_error>
#include <unordered_set>
#include <vector>

#include <fmt/format.h>

#include "base/Error.h"
#include "base/Extension.h"
#include "base/Names.h"
#include "scenes/AreaLight.h"
#include "scenes/Clips.h"
#include "scenes/Defaults.h"
#include "scenes/InUse.h"
#include "scenes/Limits.h"
#include "scenes/LoadLedger.h"
#include "scenes/Pose.h"
#include "scenes/Rest.h"
#include "scenes/RigLinks.h"
#include "scenes/TextureLimits.h"
#include "scenes/import/Importers.h"

namespace tessera::scenes {
namespace {

struct Format {
    std::string_view extension;
    Scene (*import)(const std::filesystem::path&, LoadLedger&);
    bool isModel = true; ///< a format without display settings
};
constexpr std::array kFormats = {Format{".gltf", importGltf}, Format{".glb", importGltf}, Format{".obj", importObj},
                                 Format{".json", importSceneJson, false}};

const Format* formatOf(const std::filesystem::path& file) {
    const std::string extension = extensionOf(file);
    const auto found = std::find_if(kFormats.begin(), kFormats.end(),
                                    [&](const Format& format) { return format.extension == extension; });
    return found == kFormats.end() ? nullptr : &*found;
}

/// Suggests the folder's scene file if there is just one: most models come in a folder of their own.
[[noreturn]] void refuseFolder(const std::string& path) {
    std::vector<std::string> files;
    std::error_code failure;
    for (std::filesystem::directory_iterator at(path, failure), end; !failure && at != end && files.size() < 2;
         at.increment(failure)) {
        if (formatOf(at->path()) != nullptr && at->is_regular_file(failure)) files.push_back(at->path().string());
    }
    throw InputError(fmt::format("{}: is a folder; give {}", path,
                                 files.size() == 1 ? fmt::format("the scene in it, '{}'", files.front())
                                                   : "a .gltf, .glb, .obj or .json file"));
}

void requireRadiance(const glm::dvec3& background) {
    const auto isRadiance = [](double value) {
        return value >= 0.0 && value <= double(std::numeric_limits<float>::max());
    };
    if (isRadiance(background.x) && isRadiance(background.y) && isRadiance(background.z)) return;
    throw InputError(fmt::format("cannot use the background {},{},{}; give three finite numbers, each 0 or more",
                                 background.x, background.y, background.z));
}

bool isModel(const std::string& path) {
    const Format* const format = formatOf(path);
    return format != nullptr && format->isModel;
}

Scene importFile(const std::string& path, LoadLedger& ledger) {
    const std::filesystem::path file(path);
    const Format* format = formatOf(file);
    std::error_code failure;
    if (!std::filesystem::exists(file, failure)) {
        if (path.find("://") != path.npos) throw InputError(path + ": is a URL; download the file and give its path");
        if (format != nullptr || file.has_parent_path()) throw InputError(path + ": no such file; check the path");
        std::vector<std::string_view> names;
        for (const BuiltinScene& scene : builtinScenes()) names.push_back(scene.name);
        throw InputError("no built-in scene or file is called '" + path + "'; " + suggestNames(path, names));
    }
    if (std::filesystem::is_directory(file, failure)) refuseFolder(path);
    if (format == nullptr) {
        throw InputError(path + ": not a scene file; give a .gltf, .glb, .obj or .json file (Blender, for one, exports "
                                "glTF)");
    }
    return format->import(file, ledger);
}

void takeWarnings(LoadLedger& ledger, std::vector<std::string>& warnings) {
    const std::vector<std::string> ofPictures = ledger.takeWarnings();
    warnings.insert(warnings.end(), ofPictures.begin(), ofPictures.end());
}

/// Truncates the warnings: a file may cause one in every line.
void keepFirstWarnings(std::vector<std::string>& warnings) {
    constexpr std::size_t kMostWarnings = 100;
    if (warnings.size() <= kMostWarnings) return;
    const std::size_t more = warnings.size() - kMostWarnings;
    warnings.resize(kMostWarnings);
    warnings.push_back("and " + std::to_string(more) + " more warnings");
}

/// `text` without each occurrence of `part` that begins a word.
std::string without(std::string_view part, std::string text) {
    if (part.empty()) return text;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos;) {
        if (at == 0 || std::string_view(" '\"(").find(text[at - 1]) != std::string_view::npos)
            text.erase(at, part.size());
        else
            ++at;
    }
    return text;
}

/// Makes file names in warnings relative to the scene's folder, and drops the name of the scene's file, which is
/// printed with them. Removes duplicates, which included files may cause.
void shortenWarnings(std::vector<std::string>& warnings, const std::string& path) {
    const std::string folder = std::filesystem::path(path).parent_path().string(), own = path + ": ";
    std::unordered_set<std::string> said;
    std::vector<std::string> kept;
    for (std::string& warning : warnings) {
        std::string text = warning.starts_with(own) ? warning.substr(own.size()) : std::move(warning);
        text = without(folder.empty() || folder.ends_with('/') ? folder : folder + '/', std::move(text));
        if (said.insert(text).second) kept.push_back(std::move(text));
    }
    warnings = std::move(kept);
}

/// Warns of area lights that are enabled but have no surface.
void warnOfDarkAreas(Scene& scene) {
    std::size_t count = 0;
    std::string first;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        if (!light.enabled || !infoOf(light.type).isArea || hasSurface(light)) continue;
        if (count++ == 0) first = light.name.empty() ? fmt::format("number {}", i) : fmt::format("'{}'", light.name);
    }
    if (count == 1)
        scene.warnings.push_back(fmt::format("the light {} has an area of 0 and stays dark; give it a size", first));
    if (count > 1)
        scene.warnings.push_back(
            fmt::format("{} lights have an area of 0 and stay dark, first {}; give them a size", count, first));
}

void warnOfBlackMaterials(Scene& scene) {
    if (isAllBlack(scene))
        scene.warnings.push_back("all surfaces are black: their base colour is 0, and they neither reflect nor emit "
                                 "light; give their materials a base colour");
}

void requireVariant(const Scene& scene, const std::string& nameOrPath, const ImportOptions& importOptions) {
    if (!importOptions.variant || std::ranges::find(scene.variants, *importOptions.variant) != scene.variants.end())
        return;
    if (scene.variants.empty())
        throw InputError(fmt::format("{}: no model of the scene has variants, so none is called '{}'", nameOrPath,
                                     *importOptions.variant));
    const std::vector<std::string_view> names(scene.variants.begin(), scene.variants.end());
    throw InputError(fmt::format("{}: no variant of the scene's models is called '{}'; {}", nameOrPath,
                                 *importOptions.variant, suggestNames(*importOptions.variant, names)));
}

void goOn(const LoadOptions& options) {
    if (options.stop.stop_requested()) throw LoadStopped();
}

} // namespace

const BuiltinScene* builtinScene(std::string_view name) {
    const std::span<const BuiltinScene> scenes = builtinScenes();
    const auto found =
        std::find_if(scenes.begin(), scenes.end(), [&](const BuiltinScene& s) { return s.name == name; });
    return found == scenes.end() ? nullptr : &*found;
}

Scene makeBuiltin(const BuiltinScene& builtin, const LoadOptions& options, LoadLedger& ledger, const std::string& who) {
    constexpr std::uint64_t kCopies = 3; // while a vector grows, and in the scene
    const std::uint64_t mark = ledger.usedBytes();
    const auto lights = static_cast<std::uint64_t>(options.lights.value_or(0));
    ledger.charge(builtin.bytes + kCopies * lights * sizeof(Light), [&] { return who; });
    Scene scene = builtin.make(options, ledger);
    ledger.settle(mark, bytesOf(scene));
    return scene;
}

std::optional<Environment> environmentCalled(const std::string& name, LoadLedger& ledger,
                                             std::vector<std::string>& warnings) {
    if (name == kNoEnvironment) return {};
    const auto checked = [&](const std::string& source) {
        Environment environment = loadEnvironment(source, ledger, warnings);
        takeWarnings(ledger, warnings);
        Scene bare;
        bare.name = name;
        checkEnvironment(bare, environment);
        return environment;
    };
    if (name.starts_with(kBuiltinPrefix)) return checked(name);
    const auto builtins = builtinEnvironments();
    if (std::ranges::find(builtins, name, &BuiltinEnvironment::name) != builtins.end())
        return checked(std::string(kBuiltinPrefix) + name);
    std::error_code failure;
    const std::filesystem::file_status status = std::filesystem::status(name, failure);
    if (std::filesystem::is_directory(status))
        throw InputError(name + ": is a folder; give a picture file or a glTF model in it");
    if (!std::filesystem::exists(status)) {
        std::vector<std::string_view> names{kNoEnvironment};
        for (const BuiltinEnvironment& builtin : builtins) names.push_back(builtin.name);
        throw InputError("no built-in environment or picture file is called '" + name + "'; " +
                         suggestNames(name, names));
    }
    if (!std::filesystem::is_regular_file(status))
        throw InputError(name + ": is not a regular file; name the picture itself");
    return checked(name);
}

Scene loadScene(const std::string& nameOrPath, const LoadOptions& options) {
    if (options.lights && (*options.lights < 0 || *options.lights > kMostLights)) {
        throw InputError(fmt::format("cannot use {} lights; give a number from 0 to {}", *options.lights, kMostLights));
    }
    if (options.background) requireRadiance(*options.background);
    goOn(options);
    Scene scene;
    LoadLedger ledger(options.memoryLimitBytes, options.import);
    ledger.reportEnvironment(options.environmentProgress);
    if (const BuiltinScene* builtin = builtinScene(nameOrPath)) {
        scene = makeBuiltin(*builtin, options, ledger, nameOrPath);
    } else {
        scene = importFile(nameOrPath, ledger);
        if (options.lights) keepLights(scene, static_cast<std::size_t>(*options.lights));
        requireDrawableLights(nameOrPath, scene.lights.size());
    }
    if (options.defaultCamera) leaveOutCameras(scene);
    OwnEnvironment own = ownEnvironmentOf(scene);
    if (options.background) scene.background = glm::vec3(*options.background);
    if (options.environment) scene.environment = environmentCalled(*options.environment, ledger, scene.warnings);
    keepTextureLimits(scene, nameOrPath, ledger);
    takeWarnings(ledger, scene.warnings);
    if (options.files != nullptr)
        options.files->insert(options.files->end(), ledger.files().begin(), ledger.files().end());
    requireVariant(scene, nameOrPath, options.import);
    warnOfDarkAreas(scene);
    shortenWarnings(scene.warnings, nameOrPath);
    shortenWarnings(scene.notes, nameOrPath);
    keepFirstWarnings(scene.warnings);
    goOn(options);
    try {
        checkScene(scene);
        for (const HookValue& value : options.hookValues) {
            if (!scene.hook)
                throw InputError(fmt::format("has no hook whose parameter '{}' could be {:g}; leave it out", value.name,
                                             value.value));
            setHookValue(*scene.hook, value);
        }
        takeRest(scene);
        if (options.clip) scene.options.clip = options.clip;
        if (scene.options.clip) playClip(scene, *scene.options.clip);
        poseScene(scene, 0.0);
    } catch (const InputError& error) {
        throw InputError(nameOrPath + ": " + error.what());
    }
    goOn(options);
    warnOfBlackMaterials(scene);
    addDefaultCamera(scene, options.aspect);
    own.studioDegrees = chosenStudioDegrees(scene);
    if (options.environment && scene.environment) layAs(own, *scene.environment);
    // A request for no lights, or for an environment or none, is respected.
    if (options.defaultLight && scene.options.defaultLight.value_or(true) && options.lights != 0 &&
        !options.environment)
        addDefaultLight(scene, ledger);
    if (!isModel(nameOrPath)) return scene;
    addDefaultToneMap(scene);
    addDefaultExposure(scene);
    if (options.defaultLight && !options.lights && !options.environment) addFillLight(scene, ledger);
    return scene;
}

} // namespace tessera::scenes
