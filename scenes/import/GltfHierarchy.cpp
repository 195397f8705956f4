#include "scenes/import/GltfSteps.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "scenes/Limits.h"
#include "scenes/Transform.h"
#include "scenes/import/GltfMaterials.h"
#include "scenes/import/GltfRig.h"

namespace tessera::scenes::gltf {
namespace {

/// One parent of each node, or -1.
std::vector<int> parentsOf(const Document& document) {
    const std::vector<tiny::Node>& nodes = document.model.nodes;
    std::vector<int> parents(nodes.size(), -1);
    for (std::size_t node = 0; node < nodes.size(); ++node)
        for (const int child : nodes[node].children) parents[std::size_t(child)] = int(node);
    return parents;
}

/// Child nodes that a scene also lists come last: they stay below their parents if these are drawn.
std::vector<int> rootsOf(const Document& document, const std::vector<int>& parents) {
    std::vector<int> roots(parents.size());
    std::iota(roots.begin(), roots.end(), 0);
    const auto isRoot = [&](int node) { return parents[std::size_t(node)] < 0; };
    if (document.scene() == nullptr)
        std::erase_if(roots, [&](int node) { return !isRoot(node); });
    else
        roots = document.scene()->nodes;
    std::stable_partition(roots.begin(), roots.end(), isRoot);
    return roots;
}

glm::dmat4 parentFromNodeOf(const Document& document, int index) {
    const tiny::Node& node = elementAt(document.model.nodes, index);
    if (!node.matrix.empty()) {
        glm::dmat4 matrix = glm::make_mat4(node.matrix.data());
        const glm::dvec4 last = glm::row(matrix, 3), affine(0.0, 0.0, 0.0, 1.0);
        if (last == affine) return matrix;
        document.repair(placeOf(index) + "/matrix", "it is divided by its last number, and the row is taken so",
                        "is not affine; its last row must be 0 0 0 1");
        return glm::row(last.w == 0.0 ? matrix : matrix / last.w, 3, affine);
    }
    glm::dvec4 rotation = rotationOf(node);
    if (glm::dot(rotation, rotation) == 0.0) {
        document.repair(placeOf(index) + "/rotation", kNotRotated, "{}", kZeroQuaternion);
        rotation = kNoRotation;
    }
    return transformOf(translationOf(node), rotation, scaleOf(node));
}

bool isFinite(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row])) return false;
    return true;
}

/// Relative tolerance of lengths and squared lengths: far above the rounding of matrices, far below visible
/// differences.
constexpr double kSameScale = 1e-4;

/// The uniform scale of a matrix; nothing if it depends on the direction or exceeds double precision.
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

/// The scale shared by all uses of a mesh or material; nothing if they share no uniform scale.
using SharedScale = std::optional<double>;

/// Adds a use. Scale 0 is invisible and ignored.
void addUse(std::map<int, SharedScale>& scales, int index, const SharedScale& use) {
    if (use == 0.0) return;
    const auto [entry, isNew] = scales.try_emplace(index, use);
    SharedScale& shared = entry->second;
    if (!isNew && shared && !(use && std::abs(*use - *shared) <= kSameScale * *shared)) shared.reset();
}

float scaledThickness(const Material& material, double scale) {
    const double most = fieldOf(kMaterialFields, &Material::thicknessMetres).most;
    return float(std::min(double(material.thicknessMetres) * scale, most));
}

/// An instance with a material that nodes show at several scales.
struct ScaledUse {
    MeshInstance* instance = nullptr;
    double scale = 1.0;
};

/// The uses of a material; nothing if a node's scale is not uniform or a clip animates the material.
std::optional<std::vector<ScaledUse>> scaledUses(Scene& scene, int material) {
    for (const RestNumber& number : scene.rig.numbers)
        if (isOfMaterial(infoOf(number.property).owner) && number.element == material) return std::nullopt;
    std::set<int> skinned; // meshes, which count as scale 1
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

/// Copies a material for each further scale at which nodes show it, with the thickness at that scale. Returns false
/// without changes if it cannot.
bool splitByScale(Context& context, int index, int material) {
    constexpr std::size_t kMostScales = 64; // each becomes a separate material
    Scene& scene = context.scene;
    std::optional<std::vector<ScaledUse>> uses = scaledUses(scene, material);
    if (!uses) return false;
    std::ranges::stable_sort(*uses, {}, &ScaledUse::scale);
    std::vector<double> scales;
    for (const ScaledUse& use : *uses)
        if (scales.empty() || use.scale > scales.back() * (1.0 + kSameScale)) scales.push_back(use.scale);
    if (scales.size() > kMostScales) return false;
    const Material original = scene.materials[std::size_t(material)];
    constexpr std::size_t kWhileGrowing = 2, kDigits = 24; // copies of the vector; digits after the name
    context.document.charge(kWhileGrowing * scales.size() * (sizeof(Material) + original.name.size() + kDigits),
                            "materials", index);
    auto use = uses->begin();
    for (const double scale : scales) {
        const bool isFirst = scale == scales.front();
        const int own = isFirst ? material : int(scene.materials.size());
        if (!isFirst) scene.materials.push_back(original);
        Material& placed = scene.materials[std::size_t(own)];
        if (!isFirst) placed.name = fmt::format("{} at scale {:g}", original.name, scale);
        placed.thicknessMetres = scaledThickness(original, scale);
        for (; use != uses->end() && use->scale <= scale * (1.0 + kSameScale); ++use) use->instance->material = own;
    }
    return true;
}

} // namespace

bool isVisible(const tiny::Node& node) {
    const tiny::Value* const visible = valueAt(node.extensions, "KHR_node_visibility/visible");
    return visible == nullptr || visible->Get<bool>();
}

std::vector<PlacedNode> placeNodes(const Document& document) {
    const std::vector<int> parents = parentsOf(document);
    const std::vector<bool> hasClip = nodesHiddenByClips(document.model);
    std::vector<PlacedNode> placed;
    struct Waiting {
        int node, parent; // as in PlacedNode
        bool isVisible;
    };
    std::vector<Waiting> waiting; // a stack, so that a deep hierarchy does not overflow the call stack
    const auto wait = [&](const std::vector<int>& nodes, int parent, bool isVisible) {
        constexpr std::size_t kCopies = 3; // while it grows; one node may have any number of entries
        document.charge(kCopies * nodes.size() * sizeof(Waiting), "/nodes");
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) waiting.push_back({*node, parent, isVisible});
    };
    std::vector<bool> isPlaced(parents.size());
    const auto placeTrees = [&](const std::vector<int>& roots, bool isDrawn) {
        wait(roots, -1, true);
        while (!waiting.empty()) {
            PlacedNode next;
            next.node = waiting.back().node;
            next.parent = waiting.back().parent;
            next.isDrawn = isDrawn;
            next.isVisible = waiting.back().isVisible;
            waiting.pop_back();
            if (isPlaced[std::size_t(next.node)]) {
                document.repair(placeOf(next.node), "the first place counts",
                                "has several parents, or is a root as well");
                continue;
            }
            isPlaced[std::size_t(next.node)] = true;
            next.isVisible = next.isVisible &&
                             (hasClip[std::size_t(next.node)] || isVisible(elementAt(document.model.nodes, next.node)));
            next.parentFromNode = parentFromNodeOf(document, next.node);
            const glm::dmat4 worldFromParent =
                next.parent >= 0 ? placed[std::size_t(next.parent)].worldFromNode : glm::dmat4(1.0);
            next.worldFromNode = worldFromParent * next.parentFromNode;
            if (!isFinite(next.worldFromNode) || !isNearEnough(glm::dvec3(next.worldFromNode[3]))) {
                document.repair(placeOf(next.node), "it is hidden with all below it",
                                "its transform, with its ancestors', is not finite or leads more than {:g} m away",
                                kFarthestMetres);
                next.isVisible = false;
                next.parentFromNode = glm::dmat4(1.0);
                next.worldFromNode = worldFromParent;
            }
            placed.push_back(next);
            wait(elementAt(document.model.nodes, next.node).children, int(placed.size()) - 1, next.isVisible);
        }
    };
    placeTrees(rootsOf(document, parents), true);
    const std::size_t drawn = placed.size();
    std::vector<bool> isFollowed(document.model.skins.size()); // each skin is followed once
    std::vector<int> climbedFrom(parents.size(), kNone);
    for (std::size_t i = 0; i < drawn; ++i) {
        const tiny::Node& node = document.model.nodes[std::size_t(placed[i].node)];
        if (node.skin == kNone || node.mesh == kNone || isFollowed[std::size_t(node.skin)]) continue;
        isFollowed[std::size_t(node.skin)] = true;
        for (int joint : elementAt(document.model.skins, node.skin).joints) {
            if (isPlaced[std::size_t(joint)]) continue;
            const int start = joint;
            climbedFrom[std::size_t(joint)] = start;
            for (int parent = parents[std::size_t(joint)]; parent >= 0 && !isPlaced[std::size_t(parent)];
                 parent = parents[std::size_t(joint)]) {
                if (std::exchange(climbedFrom[std::size_t(parent)], start) == start) break; // a cycle
                joint = parent;
            }
            placeTrees({joint}, false);
        }
    }
    return placed;
}

// ---- Instances ------------------------------------------------------------------------------------------------------

std::vector<glm::dmat4> instanceTransforms(Context& context, int node) {
    const Document& document = context.document;
    const std::string place = placeOf(node) + "/extensions/EXT_mesh_gpu_instancing/attributes";
    const std::map<std::string, int> attributes =
        integersByName(valueAt(elementAt(document.model.nodes, node).extensions, "EXT_mesh_gpu_instancing/attributes"));
    if (attributes.empty()) document.fail(place, "holds nothing that says how many instances there are");
    const std::size_t count = elementAt(document.model.accessors, attributes.begin()->second).count;
    // Empty if the attribute is missing.
    const auto valuesOf = [&](const char* name, int components) {
        const auto found = attributes.find(name);
        if (found == attributes.end()) return std::vector<float>();
        Elements read = context.accessors.elements(found->second);
        const std::string attribute = fmt::format("{}/{}", place, name);
        if (read.components != components)
            document.fail(attribute, "accessor {} has {} components an element; {} needs {}", found->second,
                          read.components, name, components);
        if (read.count != count)
            document.fail(attribute, "accessor {} has {} elements, but there are {} instances", found->second,
                          read.count, count);
        return std::move(read.values);
    };
    const std::vector<float> translations = valuesOf("TRANSLATION", 3), rotations = valuesOf("ROTATION", 4),
                             scales = valuesOf("SCALE", 3);
    document.charge(count * sizeof(glm::dmat4), place);
    std::vector<glm::dmat4> transforms;
    transforms.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto vector = [&](const std::vector<float>& values, double otherwise) {
            return values.empty() ? glm::dvec3(otherwise) : glm::dvec3(glm::make_vec3(&values[3 * i]));
        };
        glm::dvec4 rotation = rotations.empty() ? kNoRotation : glm::dvec4(glm::make_vec4(&rotations[4 * i]));
        if (glm::dot(rotation, rotation) == 0.0) {
            document.repair(place + "/ROTATION", kNotRotated, "element {} {}", i, kZeroQuaternion);
            rotation = kNoRotation;
        }
        transforms.push_back(transformOf(vector(translations, 0.0), rotation, vector(scales, 1.0)));
        if (!isFinite(transforms.back())) document.fail(place, "the transform of instance {} is not finite", i);
    }
    return transforms;
}

std::map<int, std::optional<double>> thicknessScales(const Context& context, const std::vector<PlacedNode>& allPlaced,
                                                     const Instancing& instancing) {
    const tiny::Model& model = context.document.model;
    std::map<int, SharedScale> ofMeshes, ofMaterials;
    for (const PlacedNode& placed : allPlaced) {
        const tiny::Node& node = elementAt(model.nodes, placed.node);
        if (!placed.isDrawn || node.mesh == kNone) continue;
        const auto instanced = instancing.find(placed.node);
        if (instanced == instancing.end())
            addUse(ofMeshes, node.mesh, node.skin == kNone ? uniformScale(placed.worldFromNode) : 1.0);
        else
            for (const glm::dmat4& transform : instanced->second)
                addUse(ofMeshes, node.mesh, uniformScale(placed.worldFromNode * transform));
    }
    // Once per mesh, not per node: all nodes of a file may show the same mesh of many primitives.
    for (const auto& [mesh, scale] : ofMeshes)
        for (const tiny::Primitive& primitive : elementAt(model.meshes, mesh).primitives)
            addUse(ofMaterials, context.variantMaterial(primitive).value_or(primitive.material), scale);
    return ofMaterials;
}

void placeThicknesses(Context& context, const Materials& materials) {
    for (const auto& [index, scale] : context.thicknessScales)
        for (const int imported : materials.imported(index)) {
            Material& placed = context.scene.materials[std::size_t(imported)];
            if (scale)
                placed.thicknessMetres = scaledThickness(placed, *scale);
            else if (hasBody(placed) && !splitByScale(context, index, imported))
                context.warn("the thickness of material {} is taken in metres, since the nodes that show it "
                             "do not share one scale that is the same in all directions",
                             index);
        }
}

} // namespace tessera::scenes::gltf
