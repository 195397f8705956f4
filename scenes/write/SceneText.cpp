#include "scenes/write/SceneText.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/Load.h"
#include "scenes/Rest.h"
#include "scenes/write/ElementJson.h"

namespace tessera::scenes {
namespace {

namespace fs = std::filesystem;
using write::Json;

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
    throw InputError(fmt::format("{}: {}", file.string(), what));
}

/// A file's name within the new file. Symbolic links of folders are resolved, those of the file itself are not: what a
/// base names lies beside the name it was opened by.
std::string nameIn(const std::string& source, const fs::path& file) {
    if (source.starts_with(kBuiltinPrefix)) return source;
    const fs::path named(source);
    const fs::path folder = fs::weakly_canonical(fs::absolute(file).parent_path());
    const fs::path relative = fs::weakly_canonical(named.parent_path()).lexically_relative(folder);
    // On another drive there is no relative name.
    const fs::path name = relative.empty() ? named : (relative / named.filename()).lexically_normal();
    if (name.string().find("${") != std::string::npos)
        fail(file, fmt::format("'{}' cannot be named in a scene file, where ${{…}} stands for a variable; rename it",
                               source));
    const std::string text = name.generic_string();
    return text.starts_with(kBuiltinPrefix) ? "./" + text : text;
}

void refuseWritingOver(const SceneOrigin& origin, const fs::path& file) {
    std::error_code failure;
    for (const fs::path& document : origin.documents)
        if (fs::equivalent(document, file, failure))
            fail(file, "the scene is made of this file, which says more than edits; save under another name");
}

Json baseJson(const SceneOrigin& origin, const fs::path& file) {
    Json base;
    base["file"] = nameIn(origin.base, file);
    if (origin.lights) base["lights"] = *origin.lights;
    if (!origin.useAssets) base["assets"] = false;
    if (origin.variant) base["variant"] = *origin.variant;
    return base;
}

Json materialsJson(const Scene& scene, const SceneOrigin& origin) {
    const std::vector<Material> now = restingMaterials(scene); // poses are not edits
    Json materials = Json::array();
    for (std::size_t i = 0; i < now.size(); ++i) {
        const auto replaced = origin.replacedMaterials.find(i);
        if (now[i] != origin.materials[i]) {
            Json material = {{"replaces", i}};
            material.update(write::materialJson(now[i], origin.images));
            materials.push_back(std::move(material));
        } else if (replaced != origin.replacedMaterials.end()) {
            Json material = Json::parse(replaced->second);
            if (material["name"] == now[i].name) materials.push_back(std::move(material)); // else of another variant
        }
    }
    return materials;
}

/// Writes whole numbers without a fraction: "size": [640, 360].
Json optionJson(double value) {
    constexpr double kMostWhole = 9007199254740992.0; // 2^53
    const bool isWhole = value == std::floor(value) && std::abs(value) <= kMostWhole && !std::signbit(value);
    return isWhole ? Json(static_cast<std::uint64_t>(value)) : write::number(value);
}
Json optionJson(const std::vector<double>& list) {
    Json array = Json::array();
    for (const double value : list) array.push_back(optionJson(value));
    return array;
}
template <typename Value>
Json optionJson(const Value& value) {
    return value;
}

Json environmentJson(const Scene& scene, const fs::path& file, const EnvironmentView& seen) {
    Json object = {{"background", write::numbers(scene.background)}, {"map", nullptr}};
    if (!scene.environment) return object;
    const Environment& environment = *scene.environment;
    object["map"] = nameIn(environment.source, file);
    const EnvironmentView own = asSeen(ownViewOf(environment), seen);
    object["intensity"] = write::number(double(own.intensity));
    object["rotationDegrees"] = write::number(double(own.rotationDegrees));
    return object;
}

/// Parameter values only; the hook itself is in the base.
Json hookValuesJson(const Hook& hook) {
    Json values = Json::object();
    for (const HookParameter& parameter : hook.parameters)
        values[parameter.name] = write::number(double(parameter.value));
    return values;
}

/// `isSeen`: the environment already contains the view's rotation and intensity.
Json optionsJson(const Scene& scene, bool isSeen) {
    SceneOptions options = scene.options;
    if (isSeen) removeEnvironmentView(options);
    Json object = Json::object();
    for (const auto& [key, option] : options.requested)
        object[key] = std::visit([](const auto& value) { return optionJson(value); }, option);
    if (options.camera) object["camera"] = *options.camera;
    if (options.clip) object["clip"] = *options.clip;
    // A scene whose lights were all removed must stay dark.
    const bool isDark = scene.lights.empty() && !scene.environment;
    if (options.defaultLight || isDark) object["defaultLight"] = options.defaultLight.value_or(false);
    return object;
}

/// One element per line, so that a scene of many lights can be read, compared and edited by line.
std::string textOf(const Json& document) {
    std::string text = "{";
    for (const auto& [key, value] : document.items()) {
        text += fmt::format("{}\n  {}: ", text.size() > 1 ? "," : "", Json(key).dump());
        if (!value.is_array()) {
            text += value.dump();
            continue;
        }
        text += '[';
        for (std::size_t i = 0; i < value.size(); ++i) text += (i > 0 ? ",\n    " : "\n    ") + value[i].dump();
        text += value.empty() ? "]" : "\n  ]";
    }
    return text + "\n}\n";
}

} // namespace

void removeEnvironmentView(SceneOptions& options) {
    for (const std::string_view key : kEnvironmentViewKeys) options.requested.erase(std::string(key));
}

std::string sceneText(const Scene& scene, const SceneOrigin& origin, const fs::path& file,
                      const std::optional<EnvironmentView>& seen, std::span<const Camera> furtherCameras) {
    assert(scene.materials.size() == origin.materials.size() && scene.images.size() == origin.images);
    assert(scene.meshes.size() == origin.meshes && scene.nodes.size() == origin.nodes);
    assert(!scene.cameras.empty());
    checkScene(scene);
    refuseWritingOver(origin, file);
    Json document;
    document["tessera"] = 1;
    if (!scene.name.empty()) document["name"] = scene.name;
    document["base"] = baseJson(origin, file);
    if (Json materials = materialsJson(scene, origin); !materials.empty()) document["materials"] = std::move(materials);
    Json& lights = document["lights"] = Json::array();
    for (const Light& light : scene.lights)
        lights.push_back(write::lightJson(light, light.texture ? nameIn(light.texture->source, file) : ""));
    Json& cameras = document["cameras"] = Json::array();
    for (const std::span<const Camera> some : {std::span(scene.cameras), furtherCameras})
        for (const Camera& camera : some) cameras.push_back(write::cameraJson(camera));
    document["environment"] = environmentJson(scene, file, seen.value_or(EnvironmentView()));
    if (scene.hook && !scene.hook->parameters.empty()) document["hook"] = {{"values", hookValuesJson(*scene.hook)}};
    document["options"] = optionsJson(scene, seen && scene.environment);
    try {
        return textOf(document);
    } catch (const nlohmann::json::type_error&) { // thrown by dump() for text that is not UTF-8
        fail(file, "a name of the scene or of its file is not UTF-8, which JSON needs; rename it");
    }
}

} // namespace tessera::scenes
