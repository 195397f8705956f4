#include <algorithm>
#include <limits>
#include <system_error>
#include <unordered_map>

#include "base/Extension.h"
#include "scenes/Clips.h"
#include "scenes/Limits.h"
#include "scenes/Load.h"
#include "scenes/RigLinks.h"
#include "scenes/import/AppendScene.h"
#include "scenes/import/Files.h"
#include "scenes/import/Importers.h"
#include "scenes/import/JsonReader.h"
#include "scenes/import/SceneJsonParts.h"

namespace tessera::scenes {
namespace {

using namespace scenejson;

/// Limit of included files, counting nested ones: documents that each include the next twice would grow exponentially.
constexpr int kMostIncludes = 4096;
/// Limit of nested documents (include or base): each takes some kilobytes of the call stack.
constexpr std::size_t kMostNested = 64;
constexpr int kVersion = 1;
constexpr std::size_t kMostOptions = 256; ///< far more than there are settings

/// The part of a scene that comes from its base.
struct BaseSize {
    std::size_t materials = 0, images = 0;
    /// A variant other than the document's was requested, in which the base's materials have other indices.
    bool isInOtherVariant = false;
};

/// The names of elements of one kind so far, with their indices.
class Names {
public:
    /// Adds a name. Throws InputError at `value` if it is taken.
    void add(const std::string& name, const JsonValue& value) {
        const auto [taken, isNew] = elements_.try_emplace(name, elements_.size());
        if (!isNew) value.fail("the name '{}' is taken by element {}; give another", name, taken->second);
    }

private:
    std::unordered_map<std::string, std::size_t> elements_;
};

class DocumentImporter {
public:
    explicit DocumentImporter(LoadLedger& ledger) : ledger_(ledger) {}

    Scene import(const std::filesystem::path& file) {
        const std::uint64_t mark = ledger_.usedBytes(), keptBefore = keptBytes_;
        chain_.push_back(file);
        const std::vector<std::byte> bytes = readFileBytes(file, ledger_);
        if (bytes.empty()) throw InputError(file.string() + ": the file is empty; start with {\"tessera\": 1}");
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        const nlohmann::json document = parseJson(text, file, ledger_);
        Scene scene = readDocument(JsonValue(document, file), file);
        chain_.pop_back();
        ledger_.settle(mark, bytesOf(scene) + keptBytes_ - keptBefore);
        return scene;
    }

private:
    Scene readDocument(const JsonValue& value, const std::filesystem::path& file) {
        JsonObject document = value.object();
        Scene scene;
        readHeader(document, file, scene);
        const auto elementsOf = [&](std::string_view key, std::size_t bytesEach = 0) {
            const std::optional<JsonValue> list = document.find(key);
            if (!list) return std::vector<JsonValue>();
            constexpr std::size_t kCopies = 3; // while a vector grows, and in the scene
            ledger_.charge(list->size() * (sizeof(JsonValue) + kCopies * bytesEach),
                           [&] { return fmt::format("{}:/{}, {} elements", file.string(), key, list->size()); });
            return list->elements();
        };
        // Quick checks come before files are read, and unknown keys before everything else.
        const std::vector<JsonValue> includes = elementsOf("include");
        const std::vector<JsonValue> materials = elementsOf("materials", sizeof(Material));
        const std::vector<JsonValue> overrides = elementsOf("overrides");
        const std::vector<JsonValue> lights = elementsOf("lights", sizeof(Light));
        const std::vector<JsonValue> cameras = elementsOf("cameras", sizeof(Camera));
        const std::optional<JsonValue> environment = document.find("environment");
        const std::optional<JsonValue> hook = document.find("hook");
        const std::optional<JsonValue> options = document.find("options");
        const std::optional<JsonValue> base = document.find("base");
        const bool replacesLights = document.has("lights"), replacesCameras = document.has("cameras");
        document.done("a scene");
        EnvironmentRequest surroundings;
        if (environment) surroundings = readEnvironment(*environment);
        std::vector<Light> ownLights;
        std::vector<std::string> lightWarnings;
        std::vector<Camera> ownCameras;
        for (std::size_t i = 0; i < lights.size(); ++i)
            ownLights.push_back(
                readLight(lights[i], i, [&](const JsonValue& name) { return lightTexture(name, lightWarnings); }));
        Names cameraNames;
        for (std::size_t i = 0; i < cameras.size(); ++i) {
            ownCameras.push_back(readCamera(cameras[i], i));
            // Cameras that replace a base's may share names, like the base's.
            if (!base) cameraNames.add(ownCameras.back().name, cameras[i]);
        }

        BaseSize baseSize;
        if (base) {
            baseSize = readBase(*base, scene);
            if (replacesLights) keepLights(scene, 0);
            if (replacesCameras) dropCameras(scene);
            if (options) scene.options = SceneOptions();
        }
        scene.warnings.insert(scene.warnings.end(), lightWarnings.begin(), lightWarnings.end());
        if (surroundings.background) scene.background = *surroundings.background;
        if (environment) addEnvironment(*environment, surroundings, scene);
        for (const JsonValue& include : includes) addInclude(include, scene);
        scene.lights.insert(scene.lights.end(), ownLights.begin(), ownLights.end());
        scene.cameras.insert(scene.cameras.end(), ownCameras.begin(), ownCameras.end());
        addMaterials(materials, overrides, file, baseSize, scene);
        if (hook) readHook(*hook, scene, ledger_);
        if (options) readOptions(*options, scene);
        return scene;
    }

    static void readHeader(JsonObject& document, const std::filesystem::path& file, Scene& scene) {
        const JsonValue version = document.require("tessera");
        if (!version.isNumber() || version.number() != kVersion)
            version.fail("must be {}, the version of the format that this program reads", kVersion);
        if (const auto schema = document.find("$schema")) schema->text();
        scene.name = file.stem().string();
        if (const auto name = document.find("name")) scene.name = name->text();
    }

    /// The environment keys of a document; the base's values apply to unset ones.
    struct EnvironmentRequest {
        std::optional<glm::vec3> background;
        std::optional<JsonValue> map;
        std::optional<float> intensity, rotationDegrees;
    };

    static EnvironmentRequest readEnvironment(const JsonValue& value) {
        JsonObject environment = value.object();
        EnvironmentRequest requested;
        if (const auto background = environment.find("background")) requested.background = background->color();
        requested.map = environment.find("map");
        if (requested.map && !requested.map->isNull()) requested.map->text();
        if (const auto intensity = environment.find("intensity")) requested.intensity = intensity->single(0.0);
        if (const auto rotation = environment.find("rotationDegrees")) requested.rotationDegrees = rotation->single();
        environment.done("an environment");
        return requested;
    }

    /// Applies environment keys. A null map removes that of the base.
    void addEnvironment(const JsonValue& value, const EnvironmentRequest& requested, Scene& scene) {
        if (requested.map) scene.environment.reset();
        if (requested.map && !requested.map->isNull()) scene.environment = loadMap(*requested.map, scene.warnings);
        if (!requested.intensity && !requested.rotationDegrees) return;
        if (!scene.environment) value.fail("says how a map lies or shines, and there is none; name a 'map'");
        if (requested.intensity) scene.environment->intensity = *requested.intensity;
        if (requested.rotationDegrees) scene.environment->rotationDegrees = *requested.rotationDegrees;
    }

    Environment loadMap(const JsonValue& map, std::vector<std::string>& warnings) {
        const std::string text = map.text();
        const std::string source = text.starts_with(kBuiltinPrefix) ? text : resolveFile(map).string();
        try {
            return loadEnvironment(source, ledger_, warnings);
        } catch (const InputError& error) {
            map.fail(error.what());
        }
    }

    /// An image that several lights name is read once.
    LightTexture lightTexture(const JsonValue& name, std::vector<std::string>& warnings) {
        const std::string file = resolveFile(name).lexically_normal().string();
        const auto known = lightTextures_.find(file);
        if (known != lightTextures_.end()) return known->second;
        try {
            const LightTexture texture = loadLightTexture(file, ledger_, warnings);
            keptBytes_ += texture->map.texels.size();
            return lightTextures_[file] = texture;
        } catch (const InputError& error) {
            name.fail(error.what());
        }
    }

    /// Loads the whole base into `scene`, under this document's name.
    BaseSize readBase(const JsonValue& value, Scene& scene) {
        JsonObject object = value.object();
        const JsonValue file = object.require("file");
        LoadOptions options;
        if (const auto lights = object.find("lights")) {
            options.lights = lights->integer(0, kMostLights);
            if (!file.text().starts_with(kBuiltinPrefix))
                lights->fail("only a built-in scene makes a requested number of lights; remove it");
        }
        if (const auto assets = object.find("assets")) {
            options.useAssets = assets->boolean();
            if (!file.text().starts_with(kBuiltinPrefix))
                assets->fail("only a built-in scene chooses between models of TESSERA_ASSETS and its own; remove it");
        }
        const std::optional<JsonValue> variant = object.find("variant");
        if (variant) variant->text();
        object.done("a base");
        std::string name = std::move(scene.name);
        scene = inVariant(variant, [&] { return load(file, options); });
        scene.name = std::move(name);
        const std::optional<std::string>& requested = ledger_.importOptions().variant;
        return {scene.materials.size(), scene.images.size(), variant && requested && *requested != variant->text()};
    }

    /// Returns the result of `read` in the variant that a document names, unless another was requested before.
    template <typename Read>
    Scene inVariant(const std::optional<JsonValue>& variant, const Read& read) {
        const std::optional<std::string> before = ledger_.importOptions().variant;
        if (variant && !before) ledger_.requestVariant(variant->text());
        Scene scene = read();
        ledger_.requestVariant(before);
        if (variant && std::ranges::find(scene.variants, variant->text()) == scene.variants.end())
            variant->failUnknown("variant", variant->text(),
                                 std::vector<std::string_view>(scene.variants.begin(), scene.variants.end()));
        return scene;
    }

    void addInclude(const JsonValue& value, Scene& scene) {
        JsonObject object = value.object();
        const JsonValue file = object.require("file");
        const glm::dmat4 worldFromPart = readTransform(object);
        const std::optional<JsonValue> name = object.find("name");
        const std::string rootName = name ? name->text() : std::string();
        const std::optional<JsonValue> variant = object.find("variant");
        if (variant) variant->text();
        object.done("an include");
        countIncludes(file, 1);
        Scene part = inVariant(variant, [&] { return loadPart(file); });
        const std::string partName = part.name;
        try {
            appendScene(scene, std::move(part), name ? rootName : partName, worldFromPart);
        } catch (const InputError& error) {
            value.fail(error.what());
        }
    }

    void countIncludes(const JsonValue& file, int more) {
        if ((includes_ += more) > kMostIncludes)
            file.fail("is include number {} of the scene; at most {} are read", kMostIncludes + 1, kMostIncludes);
    }

    /// A file that is included repeatedly is read twice; the second result is kept and copied for the rest.
    Scene loadPart(const JsonValue& name) {
        const std::string text = name.text();
        const std::string file =
            text.starts_with(kBuiltinPrefix) ? text : resolveFile(name).lexically_normal().string();
        Part& part = parts_[{file, ledger_.importOptions().variant.value_or(std::string())}];
        if (part.kept) {
            countIncludes(name, part.includes);
            return copyOf(*part.kept, name);
        }
        const int before = includes_;
        Scene scene = load(name, LoadOptions{});
        part.includes = includes_ - before;
        if (part.wasRead) {
            part.kept = copyOf(scene, name);
            keptBytes_ += bytesOf(*part.kept);
        }
        part.wasRead = true;
        return scene;
    }

    Scene copyOf(const Scene& part, const JsonValue& name) {
        ledger_.charge(bytesOf(part), [&] {
            return fmt::format("{}: include {} of the scene, '{}'", name.file().string(), includes_, name.text());
        });
        return part;
    }

    Scene load(const JsonValue& name, const LoadOptions& options) {
        if (const std::string text = name.text(); text.starts_with(kBuiltinPrefix))
            return builtinCalled(name, text.substr(kBuiltinPrefix.size()), options);
        const std::filesystem::path file = resolveFile(name);
        const std::string extension = extensionOf(file);
        if (extension == ".gltf" || extension == ".glb") return importGltf(file, ledger_);
        if (extension == ".obj") return importObj(file, ledger_);
        if (extension != ".json")
            name.fail("'{}' is not a scene file; give a .gltf, .glb, .obj or .json file", name.text());
        refuseCycle(name, file);
        if (chain_.size() == kMostNested)
            name.fail("is document {} of a chain in which each includes or is based on the next; at most {} "
                      "are read",
                      chain_.size() + 1, kMostNested);
        return import(file);
    }

    Scene builtinCalled(const JsonValue& value, const std::string& name, const LoadOptions& options) {
        std::vector<std::string_view> names;
        for (const BuiltinScene& builtin : builtinScenes()) {
            if (builtin.name == name)
                return makeBuiltin(builtin, options, ledger_, fmt::format("{}: '{}'", value.file().string(), name));
            names.push_back(builtin.name);
        }
        value.failUnknown("built-in scene", name, names);
    }

    void refuseCycle(const JsonValue& name, const std::filesystem::path& file) const {
        std::error_code failure;
        const auto start = std::ranges::find_if(chain_, [&](const std::filesystem::path& open) {
            return std::filesystem::equivalent(open, file, failure);
        });
        if (start == chain_.end()) return;
        std::string text;
        for (auto open = start; open != chain_.end(); ++open) text += open->filename().string() + " -> ";
        name.fail("includes itself: {}{}; remove one of the includes", text, file.filename().string());
    }

    void addMaterials(const std::vector<JsonValue>& materials, const std::vector<JsonValue>& overrides,
                      const std::filesystem::path& file, const BaseSize& base, Scene& scene) {
        const std::size_t ownMaterials = scene.materials.size();
        Images images(scene, base.images, ledger_);
        Names names;
        for (const JsonValue& material : materials) {
            if (const auto replaces = material.object().find("replaces")) {
                replaceMaterial(material, *replaces, base, images, scene);
            } else {
                scene.materials.push_back(readMaterial(material, images));
                names.add(scene.materials.back().name, material);
            }
        }
        std::vector<bool> wasUsed = usedMaterials(scene);
        applyOverrides(overrides, scene, ownMaterials, images);
        dropReplacedMaterials(scene, ownMaterials, wasUsed, file);
    }

    static void replaceMaterial(const JsonValue& material, const JsonValue& replaces, const BaseSize& base,
                                Images& images, Scene& scene) {
        if (base.materials == 0) replaces.fail("there is no material of a base to replace; remove it");
        if (base.isInOtherVariant) {
            const auto there = std::size_t(replaces.integer(0, std::numeric_limits<int>::max()));
            const std::string name = material.object().require("name").text();
            if (there >= base.materials || scene.materials[there].name != name) {
                scene.warnings.push_back(
                    fmt::format("{}: '{}', which replaces material {}, is not in this variant and left out",
                                material.file().string(), name, there));
                return;
            }
        }
        const auto index = std::size_t(replaces.integer(0, int(base.materials) - 1));
        scene.materials[index] = readMaterial(material, images);
    }

    static void readOptions(const JsonValue& value, Scene& scene) {
        JsonObject object = value.object();
        SceneOptions& options = scene.options;
        if (value.size() > kMostOptions)
            value.fail("has {} members; at most {} are allowed", value.size(), kMostOptions);
        for (const std::string& key : object.keys()) {
            const JsonValue option = object.require(key);
            if (key == "defaultLight") {
                options.defaultLight = option.boolean();
            } else if (key == "camera") {
                options.camera = option.text();
                std::vector<std::string_view> names;
                for (const Camera& known : scene.cameras) names.push_back(known.name);
                if (std::ranges::find(names, *options.camera) == names.end())
                    option.failUnknown("camera", *options.camera, names);
            } else if (key == "clip") {
                options.clip = option.text();
                try {
                    clipsCalled(scene.rig, *options.clip);
                } catch (const InputError& error) {
                    option.fail(error.what());
                }
            } else {
                options.requested[key] = readOption(option); // checked by the layers above, which define settings
            }
        }
    }

    static OptionValue readOption(const JsonValue& value) {
        if (value.isBoolean()) return value.boolean();
        if (value.isNumber()) return value.number();
        if (value.isText()) return value.text();
        if (!value.isArray())
            value.fail("is no setting's value; give a name, a number, true or false, or an array of numbers");
        constexpr std::size_t kMostElements = 16;
        std::vector<double> list;
        for (const JsonValue& element : value.elements(0, kMostElements)) list.push_back(element.number());
        return list;
    }

    /// An included file.
    struct Part {
        bool wasRead = false;
        int includes = 0; ///< within it
        std::optional<Scene> kept;
    };

    LoadLedger& ledger_;
    std::map<std::pair<std::string, std::string>, Part> parts_; ///< by file and variant
    std::map<std::string, LightTexture> lightTextures_;         ///< by file
    std::uint64_t keptBytes_ = 0;                               ///< of the scenes and images in both
    std::vector<std::filesystem::path> chain_; ///< the documents being read, each included by the one before
    int includes_ = 0;
};

} // namespace

Scene importSceneJson(const std::filesystem::path& file, LoadLedger& ledger) {
    const std::uint64_t mark = ledger.usedBytes();
    Scene scene = DocumentImporter(ledger).import(file);
    ledger.settle(mark, bytesOf(scene));
    return scene;
}

} // namespace tessera::scenes
