#include <algorithm>
#include <cctype>
#include <system_error>

#include "scenes/Error.h"
#include "scenes/Load.h"
#include "scenes/import/AppendScene.h"
#include "scenes/import/FileBytes.h"
#include "scenes/import/Importers.h"
#include "scenes/import/JsonText.h"
#include "scenes/import/SceneJsonLights.h"
#include "scenes/import/SceneJsonMaterials.h"
#include "scenes/import/SceneJsonOverrides.h"
#include "scenes/import/SceneJsonTransform.h"

namespace tessera::scenes {
namespace {

using namespace scenejson;

/// Included files in all, nested ones counted: documents that each include the next one twice would grow without end.
constexpr int kMostIncludes = 4096;
constexpr int kVersion = 1;
constexpr int kMostPixelsASide = 16384; ///< the largest target of current hardware
constexpr std::string_view kBuiltin = "builtin:";

/// How much of a scene its base made.
struct BaseSize {
    std::size_t materials, images;
};

class SceneJsonImporter {
public:
    Scene import(const std::filesystem::path& file) {
        chain_.push_back(file);
        const std::vector<std::byte> bytes = readFileBytes(file);
        if (bytes.empty()) throw InputError(file.string() + ": the file is empty; start with {\"tessera\": 1}");
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        const nlohmann::json document = parseJson(text, file);
        Scene scene = readDocument(JsonValue(document, file), file);
        chain_.pop_back();
        return scene;
    }

private:
    Scene readDocument(const JsonValue& value, const std::filesystem::path& file) {
        JsonObject document = value.object();
        Scene scene;
        readHeader(document, file, scene);
        const auto elementsOf = [&](std::string_view key) {
            const std::optional<JsonValue> list = document.find(key);
            return list ? list->elements() : std::vector<JsonValue>();
        };
        // Everything that is quick to check comes before the files, and unknown keys before all of it.
        const std::vector<JsonValue> includes = elementsOf("include");
        const std::vector<JsonValue> materials = elementsOf("materials");
        const std::vector<JsonValue> overrides = elementsOf("overrides");
        const std::vector<JsonValue> lights = elementsOf("lights");
        const std::vector<JsonValue> cameras = elementsOf("cameras");
        const std::optional<JsonValue> environment = document.find("environment");
        const std::optional<JsonValue> options = document.find("options");
        const std::optional<JsonValue> base = document.find("base");
        const bool replacesLights = document.has("lights"), replacesCameras = document.has("cameras");
        document.done("a scene");
        std::optional<glm::vec3> background;
        if (environment) background = readEnvironment(*environment);
        std::vector<Light> ownLights;
        std::vector<Camera> ownCameras;
        for (std::size_t i = 0; i < lights.size(); ++i) ownLights.push_back(readLight(lights[i], i));
        for (std::size_t i = 0; i < cameras.size(); ++i) {
            // Those that replace a base's may share names, as its own may.
            if (base)
                ownCameras.push_back(readCamera(cameras[i], i));
            else
                addUnique(readCamera(cameras[i], i), cameras[i], ownCameras);
        }

        if (base) {
            readBase(*base, scene);
            if (replacesLights) scene.lights.clear();
            if (replacesCameras) scene.cameras.clear();
            if (options) scene.options = SceneOptions();
        }
        const BaseSize baseSize{scene.materials.size(), scene.images.size()};
        if (background) scene.background = *background;
        for (const JsonValue& include : includes) addInclude(include, scene);
        scene.lights.insert(scene.lights.end(), ownLights.begin(), ownLights.end());
        scene.cameras.insert(scene.cameras.end(), ownCameras.begin(), ownCameras.end());
        addMaterials(materials, overrides, file, baseSize, scene);
        if (options) readOptions(*options, scene);
        return scene;
    }

    static void readHeader(JsonObject& document, const std::filesystem::path& file, Scene& scene) {
        const JsonValue version = document.require("tessera");
        if (!version.isNumber() || version.number() != kVersion)
            version.fail(fmt::format("must be {}, the version of the format that this program reads", kVersion));
        if (const auto schema = document.find("$schema")) schema->text();
        scene.name = file.stem().string();
        if (const auto name = document.find("name")) scene.name = name->text();
    }

    static std::optional<glm::vec3> readEnvironment(const JsonValue& value) {
        JsonObject environment = value.object();
        for (const char* key : {"map", "file", "texture"})
            if (environment.has(key)) value.fail("environment maps are not shaded yet; give a 'background' colour");
        std::optional<glm::vec3> radiance;
        if (const auto background = environment.find("background")) radiance = background->color();
        environment.done("an environment");
        return radiance;
    }

    /// All of a scene as it is alone, under the name of this one.
    void readBase(const JsonValue& value, Scene& scene) {
        JsonObject object = value.object();
        const JsonValue file = object.require("file");
        LoadOptions options;
        if (const auto lights = object.find("lights")) {
            options.lights = lights->integer(0, kMostLights);
            if (!file.text().starts_with(kBuiltin))
                lights->fail("only a built-in scene makes as many lights as it is asked for; remove it");
        }
        object.done("a base");
        std::string name = std::move(scene.name);
        scene = load(file, options);
        scene.name = std::move(name);
    }

    template <typename Element>
    static void addUnique(Element element, const JsonValue& value, std::vector<Element>& elements,
                          std::size_t first = 0) {
        for (std::size_t i = first; i < elements.size(); ++i)
            if (elements[i].name == element.name)
                value.fail(fmt::format("the name '{}' is taken by element {}; give another", element.name, i - first));
        elements.push_back(std::move(element));
    }

    void addInclude(const JsonValue& value, Scene& scene) {
        JsonObject object = value.object();
        const JsonValue file = object.require("file");
        const glm::dmat4 worldFromPart = readTransform(object);
        const std::optional<JsonValue> name = object.find("name");
        const std::string rootName = name ? name->text() : std::string();
        object.done("an include");
        if (++includes_ > kMostIncludes)
            file.fail(fmt::format("is include number {} of the scene; at most {} are read", includes_, kMostIncludes));
        Scene part = load(file, LoadOptions{});
        const std::string partName = part.name;
        appendScene(scene, std::move(part), name ? rootName : partName, worldFromPart);
    }

    Scene load(const JsonValue& name, const LoadOptions& options) {
        if (const std::string text = name.text(); text.starts_with(kBuiltin))
            return builtinCalled(name, text.substr(kBuiltin.size()), options);
        const std::filesystem::path file = resolveFile(name);
        std::string extension = file.extension().string();
        std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
        if (extension == ".gltf" || extension == ".glb") return importGltf(file);
        if (extension == ".obj") return importObj(file);
        if (extension != ".json")
            name.fail(fmt::format("'{}' is not a scene file; give a .gltf, .glb, .obj or .json file", name.text()));
        refuseCycle(name, file);
        return import(file);
    }

    static Scene builtinCalled(const JsonValue& value, const std::string& name, const LoadOptions& options) {
        std::vector<std::string_view> names;
        for (const BuiltinScene& builtin : builtinScenes()) {
            if (builtin.name == name) return builtin.make(options);
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
        name.fail(fmt::format("includes itself: {}{}; remove one of the includes", text, file.filename().string()));
    }

    static void addMaterials(const std::vector<JsonValue>& materials, const std::vector<JsonValue>& overrides,
                             const std::filesystem::path& file, const BaseSize& base, Scene& scene) {
        const std::size_t ownMaterials = scene.materials.size();
        Images images(scene, base.images);
        for (const JsonValue& material : materials) {
            if (const auto replaces = material.object().find("replaces")) {
                replaceMaterial(material, *replaces, base, images, scene);
            } else {
                addUnique(readMaterial(material, images), material, scene.materials, ownMaterials);
            }
        }
        std::vector<bool> wasUsed = usedMaterials(scene);
        for (const JsonValue& override : overrides) applyOverride(override, scene, ownMaterials, images);
        dropReplacedMaterials(scene, ownMaterials, wasUsed, file);
    }

    static void replaceMaterial(const JsonValue& material, const JsonValue& replaces, const BaseSize& base,
                                Images& images, Scene& scene) {
        if (base.materials == 0) replaces.fail("there is no material of a base to replace; remove it");
        const auto index = static_cast<std::size_t>(replaces.integer(0, static_cast<int>(base.materials) - 1));
        scene.materials[index] = readMaterial(material, images);
    }

    static void readOptions(const JsonValue& value, Scene& scene) {
        JsonObject object = value.object();
        SceneOptions& options = scene.options;
        if (const auto technique = object.find("technique")) options.technique = technique->text();
        if (const auto layout = object.find("layout")) options.layout = layout->text();
        if (const auto toneMap = object.find("toneMap")) options.toneMap = toneMap->text();
        if (const auto light = object.find("defaultLight")) options.defaultLight = light->boolean();
        if (const auto exposure = object.find("exposureEV")) options.exposureEV = exposure->single();
        if (const auto size = object.find("size")) {
            const std::vector<JsonValue> sides = size->elements(2, 2);
            options.sizePixels = {sides[0].integer(1, kMostPixelsASide), sides[1].integer(1, kMostPixelsASide)};
        }
        if (const auto camera = object.find("camera")) {
            options.camera = camera->text();
            std::vector<std::string_view> names;
            for (const Camera& known : scene.cameras) names.push_back(known.name);
            if (std::ranges::find(names, *options.camera) == names.end())
                camera->failUnknown("camera", *options.camera, names);
        }
        object.done("an options object");
    }

    std::vector<std::filesystem::path> chain_; ///< the documents being read, each included by the one before
    int includes_ = 0;
};

} // namespace

Scene importSceneJson(const std::filesystem::path& file) {
    return SceneJsonImporter().import(file);
}

} // namespace tessera::scenes
