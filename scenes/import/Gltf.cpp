

#include "scenes/import/GltfMaterials.h"
#include "scenes/import/GltfRig.h"
#include "scenes/import/GltfSteps.h"
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
        const auto& primitives = elementAt(context_.document.model.meshes, mesh).primitives;
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            std::optional<Shape> imported = importPrimitive(context_, mesh, int(i));
            if (!imported) continue;
            const int sceneMesh = int(context_.scene.meshes.size());
            const ShownMaterial shown = materials_.shownBy(primitives[i], imported->rest);
            context_.scene.meshes.push_back(std::move(imported->rest));
            context_.noteMesh(sceneMesh, primitives[i], shown.lostSets);
            entry->second.push_back({sceneMesh, materials_.material(shown)});
        }
        return entry->second;
    }

private:
    Context& context_;
    Materials& materials_;
    std::map<int, std::vector<MeshInstance>> imported_;
};

/// Adds one node per instance below the node of its mesh. Called when all nodes of the document are in the scene, so
/// that their indices do not change.
void addInstances(Context& context, Meshes& meshes, const Instancing& instancing, const std::vector<int>& sceneNodes) {
    std::vector<Node>& nodes = context.scene.nodes;
    for (const auto& [index, transforms] : instancing) {
        const int parent = sceneNodes[std::size_t(index)];
        const std::string name = nodes[std::size_t(parent)].name;
        const std::vector<MeshInstance>& drawn =
            meshes.instancesOf(elementAt(context.document.model.nodes, index).mesh);
        constexpr std::size_t kCopies = 2, kDigits = 24; // copies while the vector grows; digits after the name
        const std::size_t bytesEach = sizeof(Node) + name.size() + kDigits + drawn.size() * sizeof(MeshInstance);
        context.document.charge(kCopies * transforms.size() * bytesEach, "nodes", index);
        for (std::size_t i = 0; i < transforms.size(); ++i) {
            Node& node = nodes.emplace_back();
            node.name = fmt::format("{} {}", name, i);
            node.parent = parent;
            node.parentFromNode = transforms[i];
            node.instances = drawn;
        }
    }
}

/// Warns of unsupported extensions; those that the model requires are reported already.
void warnOfIgnoredFeatures(Context& context) {
    const tiny::Model& model = context.document.model;
    for (const std::string& extension : model.extensionsUsed)
        if (!isSupported(extension) && std::ranges::count(model.extensionsRequired, extension) == 0)
            context.warn("the extension {} is not supported and was ignored{}", extension,
                         extension == "KHR_materials_diffuse_transmission" // its name does not imply what is drawn
                             ? "; its materials let through only what their alpha does"
                             : "");
}

} // namespace

Scene importGltf(const std::filesystem::path& file, LoadLedger& ledger) {
    const std::uint64_t mark = ledger.usedBytes();
    Repairs repairs(ledger.importOptions().isStrict);
    Document document = loadDocument(file, ledger, repairs);
    Scene scene;
    takeLightUnits(document, scene.notes);
    scene.name = file.stem().string();
    Context context{document, scene};
    warnOfIgnoredFeatures(context);

    constexpr std::size_t kCopies = 2; // while a vector grows
    const std::size_t nodeCount = document.model.nodes.size();
    ledger.charge(kCopies * nodeCount * (sizeof(PlacedNode) + sizeof(Node)),
                  [&] { return fmt::format("{}: /nodes, {} elements", document.file, nodeCount); });
    Materials materials(context);
    Meshes meshes(context, materials);
    const std::vector<PlacedNode> allPlaced = placeNodes(document);
    std::vector<int> sceneNodes(nodeCount, kNone);
    for (std::size_t i = 0; i < allPlaced.size(); ++i) sceneNodes[std::size_t(allPlaced[i].node)] = int(i);
    Rigging rigging(context, materials, sceneNodes);
    Instancing instancing;
    bool hasMeshes = false;
    for (const PlacedNode& placed : allPlaced) {
        const tiny::Node& stored = elementAt(document.model.nodes, placed.node);
        Node node;
        node.name = nameOr(stored.name, "node", placed.node);
        node.parent = placed.parent;
        node.parentFromNode = placed.parentFromNode;
        const bool isDrawn = placed.isDrawn && placed.isVisible;
        const bool isMesh = isDrawn && stored.mesh != kNone;
        hasMeshes = hasMeshes || isMesh;
        const bool isDeformed = isMesh && rigging.deformsOf(placed.node) != Deforms();
        const bool isInstanced = isMesh && stored.extensions.contains("EXT_mesh_gpu_instancing");
        if (isInstanced && isDeformed)
            context.warn("{}: its mesh is skinned or has morph targets that are used, so it is drawn once, "
                         "and its instances are left out",
                         placeOf(placed.node));
        const bool isRepeated = isInstanced && !isDeformed && repairs.attempt("it is drawn once", [&] {
            instancing[placed.node] = instanceTransforms(context, placed.node);
        });
        if (isMesh && !isDeformed && !isRepeated) {
            const std::vector<MeshInstance>& instances = meshes.instancesOf(stored.mesh);
            document.charge(instances.size() * sizeof(MeshInstance), "nodes", placed.node);
            node.instances = instances;
        }
        scene.nodes.push_back(std::move(node));
        if (isDeformed) rigging.addDeformed(placed.node);
        if (placed.isDrawn && stored.camera != kNone) {
            importCamera(context, placed.node, placed.worldFromNode);
            rigging.addCamera(placed.node);
        }
        if (isDrawn && lightOf(stored) != kNone) {
            importLight(context, placed.node, placed.worldFromNode);
            rigging.addLight(placed.node);
        }
    }
    addInstances(context, meshes, instancing, sceneNodes);
    importVariant(context, materials);
    context.thicknessScales = thicknessScales(context, allPlaced, instancing);
    rigging.finish();
    bindVariant(context, materials);
    placeThicknesses(context, materials);
    sizeThinSolids(scene, context.thinModes);
    repairs.attempt("its scene has no environment", [&] { importEnvironment(context); });
    const bool isEmpty = scene.lights.empty() && scene.cameras.empty();
    if (scene.meshes.empty() && (hasMeshes || isEmpty) && !repairs.first().empty()) throw InputError(repairs.first());
    for (const std::string& warning : repairs.warnings()) context.scene.warnings.push_back(warning);
    ledger.settle(mark, bytesOf(scene));
    return scene;
}

Environment importGltfEnvironment(const std::filesystem::path& file, LoadLedger& ledger,
                                  std::vector<std::string>& warnings) {
    const std::uint64_t mark = ledger.usedBytes();
    Repairs repairs(ledger.importOptions().isStrict);
    Document document = loadDocument(file, ledger, repairs);
    Scene scene;
    Context context{document, scene};
    importEnvironment(context);
    if (!scene.environment)
        throw InputError(fmt::format("{}: its scene has no light of EXT_lights_image_based; name a picture, or a model "
                                     "that has one",
                                     document.file));
    for (const std::vector<std::string>& messages : {repairs.warnings(), scene.warnings, scene.notes})
        warnings.insert(warnings.end(), messages.begin(), messages.end());
    ledger.settle(mark, scene.environment->map.texels.size());
    return std::move(*scene.environment);
}

} // namespace tessera::scenes
