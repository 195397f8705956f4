#include "scenes/import/GltfDocument.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/Error.h"
#include "scenes/import/GltfContainer.h"
#include "scenes/import/GltfHierarchy.h"
#include "scenes/import/GltfShape.h"
#include "scenes/import/JsonText.h"

namespace tessera::scenes::gltf {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kSupportedExtensions[] = {
    "EXT_meshopt_compression",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
};

bool isSupported(std::string_view extension) {
    return std::ranges::find(kSupportedExtensions, extension) != std::end(kSupportedExtensions);
}

Json parseDocument(const std::string& text, const std::string& file) {
    requireJsonDepth(text, file);
    try {
        return Json::parse(text);
    } catch (const Json::exception& error) {
        std::string what = error.what(); // "[json.exception.parse_error.101] parse error at line ..."
        if (const std::size_t end = what.find("] "); what.starts_with('[') && end != std::string::npos)
            what.erase(0, end + 2);
        std::ranges::replace(what, '\n', ' ');
        throw InputError(fmt::format("{}: is not JSON: {}", file, what));
    }
}

/// Refuses unreadable versions before the shape is checked, because another version has another shape.
void checkVersion(const Json& json, const std::string& file) {
    const auto asset = json.is_object() ? json.find("asset") : json.end();
    if (!json.is_object() || asset == json.end() || !asset->is_object())
        throw InputError(
            fmt::format("{}: /asset: is missing; every glTF 2.0 file has one, glTF 1.0 is not supported", file));
    for (const char* key : {"minVersion", "version"}) {
        const auto version = asset->find(key);
        if (version == asset->end()) continue;
        // glTF 1.0 files write a number here.
        const std::string text = version->is_string() ? version->get<std::string>() : version->dump();
        const bool good = std::string_view(key) == "version" ? text == "2" || text.starts_with("2.") : text == "2.0";
        if (!good)
            throw InputError(fmt::format(
                "{}: /asset/{}: is '{}', but only glTF 2.0 is supported; export the model as 2.0", file, key, text));
    }
}

void checkRequiredExtensions(const Document& document) {
    std::vector<std::string> missing;
    if (const auto required = document.json.find("extensionsRequired"); required != document.json.end())
        for (const Json& extension : *required)
            if (!isSupported(extension.get_ref<const std::string&>())) missing.push_back(extension.get<std::string>());
    if (!missing.empty())
        document.fail("/extensionsRequired",
                      fmt::format("the model requires {}, which {} not supported; export it without",
                                  fmt::join(missing, ", "), missing.size() == 1 ? "is" : "are"));
}

/// What tinygltf, and the importer after it, make of the elements of a document's arrays.
void chargeElements(const Document& document) {
    struct Elements {
        const char* key;
        std::size_t bytesEach;
    };
    constexpr std::size_t kCopies = 2; // while a vector grows
    constexpr Elements kElements[] = {
        {"nodes", kCopies * (sizeof(tinygltf::Node) + sizeof(PlacedNode) + sizeof(Node))},
        {"meshes", kCopies * sizeof(tinygltf::Mesh)},
        {"materials", kCopies * (sizeof(tinygltf::Material) + sizeof(Material))},
        {"accessors", kCopies * sizeof(tinygltf::Accessor)},
        {"bufferViews", kCopies * sizeof(tinygltf::BufferView)},
        {"textures", kCopies * sizeof(tinygltf::Texture)},
        {"samplers", kCopies * sizeof(tinygltf::Sampler)},
        {"scenes", kCopies * sizeof(tinygltf::Scene)},
        {"cameras", kCopies * sizeof(tinygltf::Camera)},
    };
    for (const Elements& elements : kElements)
        if (const auto found = document.json.find(elements.key); found != document.json.end())
            document.ledger.charge(found->size() * elements.bytesEach, [&] {
                return fmt::format("{}: /{}, {} elements", document.file, elements.key, found->size());
            });
}

/// Removes what would become values of tinygltf's, which are large, and is never read: extras and unknown extensions.
void stripUnread(Json& value) {
    if (value.is_object()) {
        value.erase("extras");
        if (const auto extensions = value.find("extensions"); extensions != value.end() && extensions->is_object())
            for (auto extension = extensions->begin(); extension != extensions->end();)
                extension = isSupported(extension.key()) ? std::next(extension) : extensions->erase(extension);
    }
    if (value.is_structured())
        for (Json& element : value) stripUnread(element);
}

/// Values in the extensions at any level, for each of which tinygltf keeps one of its own.
std::size_t extensionValues(const Json& value, bool isInExtension = false) {
    std::size_t count = isInExtension ? 1 : 0;
    if (!value.is_structured()) return count;
    for (auto element = value.begin(); element != value.end(); ++element)
        count += extensionValues(*element, isInExtension || (value.is_object() && element.key() == "extensions"));
    return count;
}

/// What tinygltf is given: buffers and images are left out, because they are loaded here, checked and only when used;
/// skins, animations, morph targets, extras and unknown extensions, because nothing reads them; and accessors without a
/// buffer view point at one past the document's, because tinygltf refuses index accessors that have none.
Json documentForParser(const Json& json) {
    Json stripped = json;
    for (const char* key : {"buffers", "images", "animations", "skins"}) stripped.erase(key);
    if (const auto meshes = stripped.find("meshes"); meshes != stripped.end())
        for (Json& mesh : *meshes)
            for (Json& primitive : mesh["primitives"])
                for (const char* key : {"targets", "extensions"}) primitive.erase(key);
    stripUnread(stripped);
    Json& views = stripped["bufferViews"];
    if (!views.is_array()) views = Json::array();
    const std::size_t none = views.size();
    views.push_back({{"buffer", 0}, {"byteLength", 1}});
    if (const auto accessors = stripped.find("accessors"); accessors != stripped.end())
        for (Json& accessor : *accessors)
            if (!accessor.contains("bufferView")) accessor["bufferView"] = none;
    return stripped;
}

} // namespace

void Document::fail(std::string_view place, std::string_view what) const {
    throw InputError(fmt::format("{}: {}: {}", file, place, what));
}

void Document::charge(std::uint64_t bytes, std::string_view kind, int index) const {
    ledger.charge(bytes, [&] { return fmt::format("{}: /{}/{}", file, kind, index); });
}

Document loadDocument(const std::filesystem::path& file, LoadLedger& ledger) {
    Document document{file.string(), file.parent_path(), {}, {}, {}, ledger};
    Container container = readContainer(file, ledger);
    document.binary = std::move(container.binary);
    // The document, its copy without what is loaded here, that one's text, and tinygltf's own document of it.
    ledger.charge(3 * parsedJsonBytes(container.json) + container.json.size(),
                  [&] { return document.file + ": its JSON"; });
    document.json = parseDocument(container.json, document.file);
    checkVersion(document.json, document.file);
    checkShape(document.json, document.file);
    checkRequiredExtensions(document);
    if (const auto views = document.json.find("bufferViews"); views != document.json.end())
        document.bufferViewCount = static_cast<int>(views->size());

    chargeElements(document);
    const Json stripped = documentForParser(document.json);
    constexpr std::uint64_t kCopies = 3; // while an array of them that doubles is copied
    ledger.charge(kCopies * sizeof(tinygltf::Value) * extensionValues(stripped),
                  [&] { return document.file + ": its extensions"; });
    const std::string text = stripped.dump();
    if (text.size() > std::numeric_limits<unsigned>::max())
        throw InputError(fmt::format("{}: the JSON is larger than 4 GiB; move data into .bin files", document.file));
    tinygltf::TinyGLTF parser;
    std::string errors;
    std::string warnings;
    if (!parser.LoadASCIIFromString(&document.model, &errors, &warnings, text.data(),
                                    static_cast<unsigned>(text.size()), "")) {
        while (!errors.empty() && errors.back() == '\n') errors.pop_back();
        std::ranges::replace(errors, '\n', ' ');
        throw InputError(fmt::format("{}: {}", document.file, errors.empty() ? "the glTF cannot be parsed" : errors));
    }
    return document;
}

std::vector<std::string> ignoredExtensions(const Document& document) {
    std::vector<std::string> ignored;
    for (const std::string& extension : document.model.extensionsUsed)
        if (!isSupported(extension) && std::ranges::find(ignored, extension) == ignored.end())
            ignored.push_back(extension);
    return ignored;
}

const tinygltf::Value* findExtension(const tinygltf::ExtensionMap& extensions, const std::string& name) {
    const auto found = extensions.find(name);
    return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

double numberIn(const tinygltf::Value& object, const std::string& name, double otherwise) {
    return object.Has(name) ? object.Get(name).GetNumberAsDouble() : otherwise;
}

} // namespace tessera::scenes::gltf
