#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/Transform.h"
#include "scenes/import/GltfCamerasAndLights.h"
#include "scenes/import/GltfEnvironment.h"
#include "scenes/import/GltfGeometry.h"
#include "scenes/import/GltfInstances.h"
#include "scenes/import/GltfLightUnits.h"
#include "scenes/import/GltfMaterials.h"
#include "scenes/import/GltfRig.h"
#include "scenes/import/GltfVariants.h"
#include "scenes/import/Importers.h"

namespace tessera::scenes {
namespace {

using namespace gltf;

// ---- Hierarchy -----------------------------------------------------------------------------------------------------

/// A node of the imported scene, before anything is made of it.
struct PlacedNode {
    int node = -1;       ///< in the document
    int parent = -1;     ///< in the list of placed nodes
    bool isDrawn = true; ///< false: a skin follows joints of its tree, which the scene does not have
    glm::dmat4 parentFromNode{1.0};
    glm::dmat4 worldFromNode{1.0};
};

std::string placeOf(int node) {
    return fmt::format("/nodes/{}", node);
}

/// Every node's parent, or -1.
std::vector<int> parentsOf(const Document& document) {
    const std::vector<model::Node>& nodes = document.model.nodes;
    std::vector<int> parents(nodes.size(), -1);
    for (std::size_t node = 0; node < nodes.size(); ++node)
        for (const int child : nodes[node].children) {
            int& parent = parents[static_cast<std::size_t>(child)];
            if (parent >= 0)
                document.fail(
                    placeOf(child),
                    fmt::format("is a child of both node {} and node {}; a node may have one parent", parent, node));
            parent = static_cast<int>(node);
        }
    return parents;
}

/// With one parent each, a cycle is where climbing never ends.
void refuseCycles(const Document& document, const std::vector<int>& parents) {
    enum class Mark : char { New, Climbing, Rooted };
    std::vector<Mark> marks(parents.size(), Mark::New);
    for (std::size_t start = 0; start < parents.size(); ++start) {
        std::vector<int> climbed;
        int node = static_cast<int>(start);
        while (node >= 0 && marks[static_cast<std::size_t>(node)] == Mark::New) {
            marks[static_cast<std::size_t>(node)] = Mark::Climbing;
            climbed.push_back(node);
            node = parents[static_cast<std::size_t>(node)];
        }
        if (node >= 0 && marks[static_cast<std::size_t>(node)] == Mark::Climbing)
            document.fail(placeOf(node), "is its own ancestor; the node graph must not have cycles");
        for (const int done : climbed) marks[static_cast<std::size_t>(done)] = Mark::Rooted;
    }
}

std::vector<int> rootsOf(const Document& document, const std::vector<int>& parents) {
    std::vector<int> roots;
    if (document.model.scenes.empty()) {
        for (std::size_t node = 0; node < parents.size(); ++node)
            if (parents[node] < 0) roots.push_back(static_cast<int>(node));
        return roots;
    }
    const int scene = document.model.scene;
    roots = document.model.scenes[static_cast<std::size_t>(scene)].nodes;
    std::vector<bool> isListed(parents.size(), false);
    for (const int root : roots) {
        if (isListed[static_cast<std::size_t>(root)])
            document.fail(fmt::format("/scenes/{}/nodes", scene), fmt::format("lists node {} twice", root));
        if (parents[static_cast<std::size_t>(root)] >= 0)
            document.fail(fmt::format("/scenes/{}/nodes", scene),
                          fmt::format("lists node {}, which is no root but a child of node {}", root,
                                      parents[static_cast<std::size_t>(root)]));
        isListed[static_cast<std::size_t>(root)] = true;
    }
    return roots;
}

glm::dmat4 parentFromNodeOf(const Document& document, int index) {
    const model::Node& node = document.model.nodes[static_cast<std::size_t>(index)];
    if (node.matrix) {
        const glm::dmat4& matrix = *node.matrix;
        if (glm::dvec4(matrix[0][3], matrix[1][3], matrix[2][3], matrix[3][3]) != glm::dvec4(0.0, 0.0, 0.0, 1.0))
            document.fail(placeOf(index) + "/matrix", "is not affine; its last row must be 0 0 0 1");
        return matrix;
    }
    if (glm::dot(node.rotation, node.rotation) == 0.0)
        document.fail(placeOf(index) + "/rotation", "is the zero quaternion, which is no rotation");
    return transformOf(node.translation, node.rotation, node.scale);
}

bool isFinite(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row])) return false;
    return true;
}

/// The nodes of the document's default scene, else of scene 0, else those below every root, depth first, parents before
/// children; then, not drawn, those of the trees of other joints that skins follow. Throws InputError naming the node
/// when the graph is not a forest or a transform is not finite.
std::vector<PlacedNode> placeNodes(const Document& document) {
    const std::vector<int> parents = parentsOf(document);
    refuseCycles(document, parents);
    std::vector<PlacedNode> placed;
    std::vector<PlacedNode> waiting; // a stack, so that a deep hierarchy does not overflow the call stack
    const auto wait = [&](const std::vector<int>& nodes, int parent) {
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
            PlacedNode next;
            next.node = *node;
            next.parent = parent;
            waiting.push_back(next);
        }
    };
    std::vector<bool> isPlaced(parents.size());
    const auto placeTrees = [&](const std::vector<int>& roots, bool isDrawn) {
        wait(roots, -1);
        while (!waiting.empty()) {
            PlacedNode next = waiting.back();
            waiting.pop_back();
            next.isDrawn = isDrawn;
            isPlaced[static_cast<std::size_t>(next.node)] = true;
            next.parentFromNode = parentFromNodeOf(document, next.node);
            next.worldFromNode = next.parentFromNode;
            if (next.parent >= 0)
                next.worldFromNode = placed[static_cast<std::size_t>(next.parent)].worldFromNode * next.parentFromNode;
            if (!isFinite(next.worldFromNode))
                document.fail(placeOf(next.node), "its transform, with its ancestors', is not finite");
            placed.push_back(next);
            wait(document.model.nodes[static_cast<std::size_t>(next.node)].children,
                 static_cast<int>(placed.size()) - 1);
        }
    };
    placeTrees(rootsOf(document, parents), true);
    const std::size_t drawn = placed.size();
    std::vector<bool> isFollowed(document.model.skins.size()); // once each
    for (std::size_t i = 0; i < drawn; ++i) {
        const model::Node& node = document.model.nodes[static_cast<std::size_t>(placed[i].node)];
        if (node.skin == kNone || node.mesh == kNone || isFollowed[static_cast<std::size_t>(node.skin)]) continue;
        isFollowed[static_cast<std::size_t>(node.skin)] = true;
        for (int joint : document.model.skins[static_cast<std::size_t>(node.skin)].joints) {
            if (isPlaced[static_cast<std::size_t>(joint)]) continue;
            while (parents[static_cast<std::size_t>(joint)] >= 0) joint = parents[static_cast<std::size_t>(joint)];
            placeTrees({joint}, false);
        }
    }
    return placed;
}

// ---- Scene ---------------------------------------------------------------------------------------------------------

/// The scene's meshes of each glTF mesh, imported once and shared by all nodes that draw it.
class Meshes {
public:
    Meshes(Context& context, Materials& materials) : context_(context), materials_(materials) {}

    const std::vector<MeshInstance>& instancesOf(int mesh) {
        const auto [entry, isNew] = imported_.try_emplace(mesh);
        if (!isNew) return entry->second;
        const auto& primitives = context_.document.model.meshes[static_cast<std::size_t>(mesh)].primitives;
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            std::optional<Shape> imported = importPrimitive(context_, mesh, static_cast<int>(i));
            if (!imported) continue;
            const int sceneMesh = static_cast<int>(context_.scene.meshes.size());
            context_.scene.meshes.push_back(std::move(imported->rest));
            context_.noteVariant(sceneMesh, primitives[i]);
            entry->second.push_back({sceneMesh, materials_.material(primitives[i].material)});
        }
        return entry->second;
    }

private:
    Context& context_;
    Materials& materials_;
    std::map<int, std::vector<MeshInstance>> imported_;
};

/// Of lengths and squares of them, relative: far above the rounding of matrices, and far below what shows.
constexpr double kSameScale = 1e-4;

/// Node-from-instance, by nodes of the document whose meshes are drawn several times.
using Instancing = std::map<int, std::vector<glm::dmat4>>;

/// Gives each instance a node of its own below that of its mesh. Called when all nodes of the document are in the
/// scene, so that these keep their numbers.
void addInstances(Context& context, Meshes& meshes, const Instancing& instancing, const std::vector<int>& sceneNodes) {
    std::vector<Node>& nodes = context.scene.nodes;
    for (const auto& [index, transforms] : instancing) {
        const int parent = sceneNodes[static_cast<std::size_t>(index)];
        const std::string name = nodes[static_cast<std::size_t>(parent)].name;
        const std::vector<MeshInstance>& drawn =
            meshes.instancesOf(context.document.model.nodes[static_cast<std::size_t>(index)].mesh);
        constexpr std::size_t kCopies = 2, kDigits = 24; // while the vector grows; behind the name
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

/// By which a matrix scales lengths in all directions; nothing where that depends on the direction, or leaves double
/// precision.
std::optional<double> uniformScale(const glm::dmat4& matrix) {
    const double scale = glm::length(glm::dvec3(matrix[0])), square = scale * scale;
    if (!std::isfinite(square)) return std::nullopt;
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j) {
            const double wanted = i == j ? square : 0.0;
            if (std::abs(glm::dot(glm::dvec3(matrix[i]), glm::dvec3(matrix[j])) - wanted) > kSameScale * square)
                return std::nullopt;
        }
    return scale;
}

/// By which all uses of a thing scale lengths; nothing where they do not share one scale for all directions.
using SharedScale = std::optional<double>;

/// Adds a use. One of scale 0 is not seen, and does not count.
void addUse(std::map<int, SharedScale>& scales, int index, const SharedScale& use) {
    if (use == 0.0) return;
    const auto [entry, isNew] = scales.try_emplace(index, use);
    SharedScale& shared = entry->second;
    if (!isNew && shared && !(use && std::abs(*use - *shared) <= kSameScale * *shared)) shared.reset();
}

/// A document states thicknesses in the space of each mesh, the scene in metres of the world. Source:
/// KHR_materials_volume, "Properties". What a skin moves is taken to be as large as its mesh.
std::map<int, std::optional<double>> thicknessScales(const Context& context, const std::vector<PlacedNode>& allPlaced,
                                                     const Instancing& instancing) {
    const model::Model& model = context.document.model;
    std::map<int, SharedScale> ofMeshes, ofMaterials;
    for (const PlacedNode& placed : allPlaced) {
        const model::Node& node = model.nodes[static_cast<std::size_t>(placed.node)];
        if (!placed.isDrawn || node.mesh == kNone) continue;
        const auto instanced = instancing.find(placed.node);
        if (instanced == instancing.end())
            addUse(ofMeshes, node.mesh, node.skin == kNone ? uniformScale(placed.worldFromNode) : 1.0);
        else
            for (const glm::dmat4& transform : instanced->second)
                addUse(ofMeshes, node.mesh, uniformScale(placed.worldFromNode * transform));
    }
    // Once for each mesh: all nodes of a file may show the same one, of many primitives.
    for (const auto& [mesh, scale] : ofMeshes)
        for (const model::Primitive& primitive : model.meshes[static_cast<std::size_t>(mesh)].primitives)
            addUse(ofMaterials, context.variantMaterial(primitive).value_or(primitive.material), scale);
    return ofMaterials;
}

float scaledThickness(const Material& material, double scale) {
    const double most = fieldOf(kMaterialFields, &Material::thicknessMetres).most;
    return static_cast<float>(std::min(double(material.thicknessMetres) * scale, most));
}

/// Of the instances that show a material, where nodes show it at several scales.
struct ScaledUse {
    MeshInstance* instance = nullptr;
    double scale = 1.0;
};

/// None where some node scales differently by direction, or a clip changes the material.
std::optional<std::vector<ScaledUse>> scaledUses(Scene& scene, int material) {
    for (const RestNumber& number : scene.rig.numbers)
        if (isOfMaterial(infoOf(number.property).owner) && number.element == material) return std::nullopt;
    std::set<int> skinned; // meshes, which are taken to be as large as they are
    for (const Deformed& deformed : scene.rig.deformed)
        if (deformed.skin != kNone) skinned.insert(deformed.mesh);
    const std::vector<glm::dmat4> worldFromNode = worldFromNodes(scene);
    std::vector<ScaledUse> uses;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        for (MeshInstance& instance : scene.nodes[i].instances) {
            if (instance.material != material) continue;
            const std::optional<double> scale =
                skinned.contains(instance.mesh) ? std::optional(1.0) : uniformScale(worldFromNode[i]);
            if (!scale) return std::nullopt;
            if (*scale > 0.0) uses.push_back({&instance, *scale});
        }
    return uses;
}

/// Gives a material as many copies as nodes show it at other scales, each as thick as these make it. False where it
/// cannot, and then changes nothing.
bool splitByScale(Context& context, int index, int material) {
    constexpr std::size_t kMostScales = 64; // each is a material that programs read on their own
    Scene& scene = context.scene;
    std::optional<std::vector<ScaledUse>> uses = scaledUses(scene, material);
    if (!uses) return false;
    std::ranges::stable_sort(*uses, {}, &ScaledUse::scale);
    std::vector<double> scales;
    for (const ScaledUse& use : *uses)
        if (scales.empty() || use.scale > scales.back() * (1.0 + kSameScale)) scales.push_back(use.scale);
    if (scales.size() > kMostScales) return false;
    const Material original = scene.materials[static_cast<std::size_t>(material)];
    constexpr std::size_t kCopies = 2, kDigits = 24; // while the vector grows; behind the name
    context.document.charge(kCopies * scales.size() * (sizeof(Material) + original.name.size() + kDigits), "materials",
                            index);
    auto use = uses->begin();
    for (const double scale : scales) {
        const bool isFirst = scale == scales.front();
        const int own = isFirst ? material : static_cast<int>(scene.materials.size());
        if (!isFirst) scene.materials.push_back(original);
        Material& placed = scene.materials[static_cast<std::size_t>(own)];
        if (!isFirst) placed.name = fmt::format("{} at scale {:g}", original.name, scale);
        placed.thicknessMetres = scaledThickness(original, scale);
        for (; use != uses->end() && use->scale <= scale * (1.0 + kSameScale); ++use) use->instance->material = own;
    }
    return true;
}

/// What clips say of them the rig scales.
void placeThicknesses(Context& context, const Materials& materials) {
    for (const auto& [index, scale] : context.thicknessScales) {
        const std::optional<int> imported = materials.imported(index);
        if (!imported) continue;
        Material& placed = context.scene.materials[static_cast<std::size_t>(*imported)];
        if (scale)
            placed.thicknessMetres = scaledThickness(placed, *scale);
        else if (hasBody(placed) && !splitByScale(context, index, *imported))
            context.warn(fmt::format("the thickness of material {} is taken in metres, since the nodes that show it do "
                                     "not share one scale that is the same in all directions",
                                     index));
    }
}

/// The replacement that is drawn for an unsupported extension, where the extension's name does not imply it.
std::string_view drawnInstead(std::string_view extension) {
    return extension == "KHR_materials_diffuse_transmission" ? "; its materials let through only what their alpha does"
                                                             : "";
}

/// Features of the document that the importer reads past, whether or not the imported scene shows them.
void warnOfIgnoredFeatures(Context& context) {
    for (const std::string& extension : ignoredExtensions(context.document))
        context.warn(
            fmt::format("the extension {} is not supported and was ignored{}", extension, drawnInstead(extension)));
}

/// Once for all, as drawings hold thousands.
void warnOfUndrawn(Context& context) {
    const auto warn = [&](const Context::Undrawn& undrawn, std::string_view what) {
        if (undrawn.count > 0)
            context.warn(fmt::format("{} primitive(s) of {} are left out, the first at {}; only triangles are drawn",
                                     undrawn.count, what, undrawn.first));
    };
    warn(context.points, "points");
    warn(context.lines, "lines");
}

} // namespace

Scene importGltf(const std::filesystem::path& file, LoadLedger& ledger) {
    const std::uint64_t mark = ledger.usedBytes();
    Document document = loadDocument(file, ledger);
    Scene scene;
    takeLightUnits(document, scene.notes);
    scene.name = file.stem().string();
    Buffers buffers(document);
    Accessors accessors(document, buffers);
    Context context{document, buffers, accessors, scene};
    warnOfIgnoredFeatures(context);

    constexpr std::size_t kCopies = 2; // while a vector grows
    const std::size_t nodeCount = document.model.nodes.size();
    ledger.charge(kCopies * nodeCount * (sizeof(PlacedNode) + sizeof(Node)),
                  [&] { return fmt::format("{}: /nodes, {} elements", document.file, nodeCount); });
    Materials materials(context);
    Meshes meshes(context, materials);
    const std::vector<PlacedNode> allPlaced = placeNodes(document);
    std::vector<int> sceneNodes(nodeCount, kNone);
    for (std::size_t i = 0; i < allPlaced.size(); ++i)
        sceneNodes[static_cast<std::size_t>(allPlaced[i].node)] = static_cast<int>(i);
    Rigging rigging(context, materials, sceneNodes);
    Instancing instancing;
    for (const PlacedNode& placed : allPlaced) {
        const model::Node& stored = document.model.nodes[static_cast<std::size_t>(placed.node)];
        Node node;
        node.name = nameOr(stored.name, "node", placed.node);
        node.parent = placed.parent;
        node.parentFromNode = placed.parentFromNode;
        const bool isDeformed = placed.isDrawn && stored.mesh != kNone && rigging.deformsOf(placed.node) != Deforms();
        const bool isInstanced = placed.isDrawn && stored.mesh != kNone && stored.instanceAttributes.has_value();
        if (isInstanced && isDeformed)
            context.warn(fmt::format("{}: its mesh is skinned or has morph targets that are used, so it is drawn once, "
                                     "and its instances are left out",
                                     placeOf(placed.node)));
        if (isInstanced && !isDeformed) instancing[placed.node] = instanceTransforms(context, placed.node);
        if (placed.isDrawn && stored.mesh != kNone && !isDeformed && !isInstanced) {
            const std::vector<MeshInstance>& instances = meshes.instancesOf(stored.mesh);
            document.charge(instances.size() * sizeof(MeshInstance), "nodes", placed.node);
            node.instances = instances;
        }
        scene.nodes.push_back(std::move(node));
        if (!placed.isDrawn) continue;
        if (isDeformed) rigging.addDeformed(placed.node);
        importCamera(context, placed.node, placed.worldFromNode);
        importLight(context, placed.node, placed.worldFromNode);
        rigging.addCarried(placed.node);
    }
    addInstances(context, meshes, instancing, sceneNodes);
    importVariant(context, materials);
    context.thicknessScales = thicknessScales(context, allPlaced, instancing);
    rigging.finish();
    bindVariant(context, materials);
    placeThicknesses(context, materials);
    warnOfUndrawn(context);
    importEnvironment(context);
    ledger.settle(mark, bytesOf(scene));
    return scene;
}

Environment importGltfEnvironment(const std::filesystem::path& file, LoadLedger& ledger,
                                  std::vector<std::string>& warnings) {
    const std::uint64_t mark = ledger.usedBytes();
    Document document = loadDocument(file, ledger);
    Scene scene;
    Buffers buffers(document);
    Accessors accessors(document, buffers);
    Context context{document, buffers, accessors, scene};
    importEnvironment(context);
    if (!scene.environment)
        throw InputError(fmt::format("{}: its scene has no light of EXT_lights_image_based; name a picture, or a model "
                                     "that has one",
                                     document.file));
    for (std::vector<std::string>* const told : {&scene.warnings, &scene.notes})
        warnings.insert(warnings.end(), told->begin(), told->end());
    ledger.settle(mark, scene.environment->map.texels.size());
    return std::move(*scene.environment);
}

} // namespace tessera::scenes
