#include "scenes/import/GltfParser.h"

#include <fstream> // which tiny_gltf.h leaves out with TINYGLTF_NO_FS
#include <limits>

#define tinygltf tessera_tinygltf
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
#undef TINYGLTF_IMPLEMENTATION
#undef tinygltf

namespace tessera::scenes::gltf {
namespace {

using Json = nlohmann::json;

Json taken(Json& document, const char* key) {
    const auto found = document.find(key);
    if (found == document.end()) return Json::array();
    Json value = std::move(*found);
    document.erase(found);
    return value;
}

/// Gives accessors without buffer view an extra one, the last: tinygltf 2.7 refuses indices without. Returns whether
/// there are any. Source: tinygltf, issues 324 and 378.
bool addMissingView(Json& document) {
    if (!document.contains("accessors")) return false;
    Json& views = document["bufferViews"];
    bool isMissing = false;
    for (Json& accessor : document["accessors"]) {
        if (accessor.contains("bufferView")) continue;
        accessor["bufferView"] = views.size();
        isMissing = true;
    }
    if (isMissing) views.push_back({{"buffer", 0}, {"byteLength", 1}});
    return isMissing;
}

/// tinygltf leaves out channels without node, as those of KHR_animation_pointer are.
void addMissingNodes(Json& document) {
    if (!document.contains("animations")) return;
    for (Json& animation : document["animations"])
        for (Json& channel : animation["channels"])
            if (Json& target = channel["target"]; !target.contains("node")) target["node"] = -1;
}

} // namespace

tiny::Model tinyModel(Json document, const std::string& file, LoadLedger& ledger) {
    taken(document, "buffers");
    document["asset"]["version"] = "2.0"; // whatever 2.x it says
    const Json images = taken(document, "images");
    const bool hasExtraView = addMissingView(document);
    addMissingNodes(document);
    tiny::Model model;
    if (document.contains("nodes")) model.nodes.reserve(document["nodes"].size());
    const std::string text = document.dump();
    document = nullptr;
    ledger.charge(text.size(), [&] { return file + ": its JSON"; });
    if (text.size() > std::numeric_limits<unsigned>::max())
        throw InputError(fmt::format("{}: its JSON is larger than 4 GiB; split the model", file));
    std::string error, warning;
    if (!tiny::TinyGLTF().LoadASCIIFromString(&model, &error, &warning, text.data(), unsigned(text.size()), ""))
        throw InputError(fmt::format("{}: {}", file, error));
    if (hasExtraView) {
        model.bufferViews.pop_back();
        const int extra = int(model.bufferViews.size());
        for (tiny::Accessor& accessor : model.accessors)
            if (accessor.bufferView == extra) accessor.bufferView = kNone;
    }
    model.images.resize(images.size());
    for (std::size_t i = 0; i < images.size(); ++i) {
        model.images[i].name = images[i].value("name", "");
        model.images[i].uri = images[i].value("uri", "");
        model.images[i].bufferView = images[i].value("bufferView", kNone);
    }
    return model;
}

} // namespace tessera::scenes::gltf
