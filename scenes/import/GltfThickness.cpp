#include "scenes/import/GltfSteps.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "scenes/Transform.h"
#include "scenes/import/GltfMaterials.h"

namespace tessera::scenes::gltf {
namespace {

/// Of lengths and squares of them, relative: far above the rounding of matrices, and far below what shows.
constexpr double kSameScale = 1e-4;

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

float scaledThickness(const Material& material, double scale) {
    const double most = fieldOf(kMaterialFields, &Material::thicknessMetres).most;
    return float(std::min(double(material.thicknessMetres) * scale, most));
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
    const Material original = scene.materials[std::size_t(material)];
    constexpr std::size_t kWhileGrowing = 2, kDigits = 24; // copies of the vector; behind the name
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
    // Once for each mesh: all nodes of a file may show the same one, of many primitives.
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
