#include <map>
#include <vector>

#include <fmt/format.h>

#include "scenes/import/GltfCameras.h"
#include "scenes/import/GltfContext.h"
#include "scenes/import/GltfGeometry.h"
#include "scenes/import/GltfHierarchy.h"
#include "scenes/import/GltfLights.h"
#include "scenes/import/GltfMaterials.h"
#include "scenes/import/Importers.h"

namespace tessera::scenes {
namespace {

using namespace gltf;

/// The scene's meshes of each glTF mesh, imported once and shared by all nodes that draw it.
class Meshes {
public:
    Meshes(Context& context, Materials& materials) : context_(context), materials_(materials) {}

    const std::vector<MeshInstance>& instancesOf(int mesh) {
        const auto [entry, isNew] = imported_.try_emplace(mesh);
        if (!isNew) return entry->second;
        const auto& primitives = context_.document.model.meshes[static_cast<std::size_t>(mesh)].primitives;
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            std::optional<Mesh> imported = importPrimitive(context_, mesh, static_cast<int>(i));
            if (!imported) continue;
            const int sceneMesh = static_cast<int>(context_.scene.meshes.size());
            context_.scene.meshes.push_back(std::move(*imported));
            entry->second.push_back({sceneMesh, materials_.material(primitives[i].material)});
        }
        return entry->second;
    }

private:
    Context& context_;
    Materials& materials_;
    std::map<int, std::vector<MeshInstance>> imported_;
};

/// The replacement that is drawn for an unsupported extension, where the extension's name does not imply it.
std::string_view drawnInstead(std::string_view extension) {
    const bool isTransparency = extension == "KHR_materials_transmission" || extension == "KHR_materials_volume" ||
                                extension == "KHR_materials_diffuse_transmission";
    return isTransparency ? "; its materials let through only what their alpha does" : "";
}

/// Features of the document that the importer reads past, whether or not the imported scene shows them.
void warnOfIgnoredFeatures(Context& context) {
    const nlohmann::json& json = context.document.json;
    for (const std::string& extension : ignoredExtensions(context.document))
        context.warn(
            fmt::format("the extension {} is not supported and was ignored{}", extension, drawnInstead(extension)));
    const auto hasSome = [&](const char* key) { return json.contains(key) && !json[key].empty(); };
    if (hasSome("skins")) context.warn("skins are not supported; skinned meshes keep their unskinned shape");
    if (hasSome("animations")) context.warn("animations are not supported; nodes stay where they are");
    if (!json.contains("meshes")) return;
    for (const nlohmann::json& mesh : json["meshes"])
        for (const nlohmann::json& primitive : mesh["primitives"])
            if (primitive.contains("targets") && !primitive["targets"].empty())
                context.warn("morph targets are not supported; morphed meshes keep their base shape");
}

} // namespace

Scene importGltf(const std::filesystem::path& file, LoadLedger& ledger) {
    const std::uint64_t mark = ledger.usedBytes();
    const Document document = loadDocument(file, ledger);
    Scene scene;
    scene.name = file.stem().string();
    Buffers buffers(document);
    Accessors accessors(document, buffers);
    Context context{document, buffers, accessors, scene};
    warnOfIgnoredFeatures(context);

    Materials materials(context);
    Meshes meshes(context, materials);
    for (const PlacedNode& placed : placeNodes(document)) {
        const tinygltf::Node& stored = document.model.nodes[static_cast<std::size_t>(placed.node)];
        Node node;
        node.name = nameOr(stored.name, "node", placed.node);
        node.parent = placed.parent;
        node.parentFromNode = placed.parentFromNode;
        if (stored.mesh >= 0) {
            const std::vector<MeshInstance>& instances = meshes.instancesOf(stored.mesh);
            document.charge(instances.size() * sizeof(MeshInstance), "nodes", placed.node);
            node.instances = instances;
        }
        scene.nodes.push_back(std::move(node));
        importCamera(context, placed.node, placed.worldFromNode);
        importLight(context, placed.node, placed.worldFromNode);
    }
    ledger.settle(mark, bytesOf(scene));
    return scene;
}

} // namespace tessera::scenes
