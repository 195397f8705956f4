#include "scenes/write/SceneOrigin.h"

#include <algorithm>
#include <array>
#include <set>

#include "base/Extension.h"
#include "scenes/Rest.h"
#include "scenes/import/Files.h"
#include "scenes/import/JsonReader.h"
#include "scenes/import/SceneJsonParts.h"

namespace tessera::scenes {
namespace {

namespace fs = std::filesystem;

bool isDocument(const fs::path& file) {
    return extensionOf(file) == ".json";
}

/// Charges the ledger until the document is read, since only one is kept at a time.
nlohmann::json documentOf(const fs::path& file, LoadLedger& ledger) {
    const std::uint64_t mark = ledger.usedBytes();
    const std::vector<std::byte> bytes = readFileBytes(file, ledger);
    nlohmann::json document = parseJson({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file, ledger);
    ledger.settle(mark, 0);
    return document;
}

bool namesAFile(const nlohmann::json& value) {
    if (value.is_object() && value.contains("file")) return true;
    return value.is_structured() && std::ranges::any_of(value, namesAFile);
}

/// True if a document holds only edits of its base, so that a new document can replace it.
bool onlyEdits(const nlohmann::json& document) {
    constexpr std::array kEdits = {"$schema", "tessera", "base",    "name",        "materials",
                                   "lights",  "cameras", "options", "environment", "hook"};
    if (!document.contains("base")) return false;
    for (const auto& [key, value] : document.items())
        if (std::ranges::find(kEdits, key) == kEdits.end()) return false;
    // Only new values of the base's hook are an edit.
    if (document.contains("hook") && !(document["hook"].is_object() && document["hook"].contains("values")))
        return false;
    const nlohmann::json materials = document.value("materials", nlohmann::json::array());
    return std::ranges::all_of(materials, [](const nlohmann::json& material) {
        // A texture given as text is a file too, and adds an image to the counted ones.
        const bool namesText = std::ranges::any_of(material, [](const nlohmann::json& parameter) {
            return parameter.is_object() && parameter.contains("texture") && parameter["texture"].is_string();
        });
        constexpr std::array kTextures = {"normalMap", "clearcoatNormalMap", "metallicRoughnessTexture",
                                          "anisotropyTexture"};
        const bool isText = std::ranges::any_of(
            kTextures, [&](const char* key) { return material.contains(key) && material[key].is_string(); });
        return material.contains("replaces") && !namesText && !isText && !namesAFile(material);
    });
}

/// The file named by `value`, which stands under `key` of the document.
fs::path fileNamed(const nlohmann::json& value, const fs::path& document, const char* key) {
    return scenejson::resolveFile(JsonValue(value["file"], document, std::string("/") + key + "/file"));
}

/// The document and all documents that it is based on or includes, each once.
std::vector<fs::path> documentsOf(const fs::path& first, LoadLedger& ledger) {
    std::vector<fs::path> documents, open{first};
    std::set<fs::path> known;
    while (!open.empty()) {
        const fs::path file = std::move(open.back());
        open.pop_back();
        if (!isDocument(file) || !known.insert(file.lexically_normal()).second) continue;
        documents.push_back(file);
        const nlohmann::json document = documentOf(file, ledger);
        const auto follow = [&](const nlohmann::json& value, const char* key) {
            if (!value["file"].get<std::string>().starts_with(kBuiltinPrefix))
                open.push_back(fileNamed(value, file, key));
        };
        if (document.contains("base")) follow(document["base"], "base");
        if (document.contains("include"))
            for (const nlohmann::json& include : document["include"]) follow(include, "include");
    }
    return documents;
}

/// Follows bases to the first document that is more than edits.
void followBases(fs::path file, SceneOrigin& origin, LoadLedger& ledger) {
    while (isDocument(file)) {
        const nlohmann::json document = documentOf(file, ledger);
        if (!onlyEdits(document)) break;
        if (document.contains("materials"))
            for (const nlohmann::json& material : document["materials"]) // upper documents take precedence
                origin.replacedMaterials.try_emplace(material["replaces"].get<std::size_t>(), material.dump());
        const nlohmann::json& base = document["base"];
        if (!origin.variant && base.contains("variant")) origin.variant = base["variant"].get<std::string>();
        if (const std::string name = base["file"]; name.starts_with(kBuiltinPrefix)) {
            origin.base = name;
            if (base.contains("lights")) origin.lights = base["lights"].get<int>();
            origin.useAssets = base.value("assets", true);
            return;
        }
        file = fileNamed(base, file, "base");
    }
    origin.base = fs::absolute(file).lexically_normal().string();
    origin.documents = documentsOf(file, ledger);
}

} // namespace

SceneOrigin originOf(const std::string& nameOrPath, const LoadOptions& options, const Scene& loaded) {
    SceneOrigin origin;
    origin.materials = restingMaterials(loaded);
    origin.images = loaded.images.size();
    origin.meshes = loaded.meshes.size();
    origin.nodes = loaded.nodes.size();
    const auto isCalled = [&](const BuiltinScene& scene) { return scene.name == nameOrPath; };
    if (std::ranges::any_of(builtinScenes(), isCalled)) {
        origin.base = std::string(kBuiltinPrefix) + nameOrPath;
        origin.lights = options.lights;
        origin.useAssets = options.useAssets;
    } else {
        origin.variant = options.import.variant;
        LoadLedger ledger(options.memoryLimitBytes);
        ledger.settle(0, bytesOf(loaded));
        followBases(nameOrPath, origin, ledger);
    }
    return origin;
}

} // namespace tessera::scenes
