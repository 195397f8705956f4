#include "scenes/InUse.h"

#include <algorithm>

namespace tessera::scenes {
namespace {

template <typename Element>
std::vector<const Element*> chosen(const std::vector<Element>& elements, const std::vector<bool>& isChosen) {
    std::vector<const Element*> result;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        if (isChosen[i]) result.push_back(&elements[i]);
    }
    return result;
}

/// Whether the base colour is 0, and nothing else of the material reflects, transmits or emits light.
bool isBlack(const Material& material) {
    constexpr glm::vec3 kNothing(0.0f);
    const MaterialModelInfo& model = infoOf(material.model);
    const bool reflects =
        model.highlight == Highlight::Tinted
            ? material.specularColor != kNothing
            : model.highlight == Highlight::Dielectric && (material.metallic > 0.0f || material.specularFactor > 0.0f);
    const bool hasLayer = model.hasLayers && (material.clearcoat > 0.0f || material.sheenColor != kNothing);
    return glm::vec3(material.baseColor) == kNothing && material.emissive == kNothing && !reflects && !hasLayer &&
           !isIridescent(material) && !isTransparent(material) && subsurfaceOf(material, {}) == SubsurfaceMethod::None;
}

} // namespace

bool isDrawn(const Scene& scene, const MeshInstance& instance) {
    return !scene.meshes[static_cast<std::size_t>(instance.mesh)].indices.empty();
}

InUse inUse(const Scene& scene) {
    InUse used{std::vector<bool>(scene.materials.size()), std::vector<bool>(scene.meshes.size())};
    // Called often, for scenes with far more nodes than materials and meshes.
    std::size_t unused = used.materials.size() + used.meshes.size();
    const auto mark = [&unused](std::vector<bool>::reference isUsed) {
        unused -= isUsed ? 0 : 1;
        isUsed = true;
    };
    for (const Node& node : scene.nodes) {
        if (unused == 0) break;
        for (const MeshInstance& instance : node.instances) {
            if (!isDrawn(scene, instance)) continue;
            mark(used.materials[static_cast<std::size_t>(instance.material)]);
            mark(used.meshes[static_cast<std::size_t>(instance.mesh)]);
        }
    }
    return used;
}

std::vector<const Material*> materialsInUse(const Scene& scene) {
    return chosen(scene.materials, inUse(scene).materials);
}

std::vector<const Mesh*> meshesInUse(const Scene& scene) {
    return chosen(scene.meshes, inUse(scene).meshes);
}

bool isAllBlack(const Scene& scene) {
    const auto ofMaterial = [](const RestNumber& number) { return isOfMaterial(infoOf(number.property).owner); };
    const std::vector<const Material*> materials = materialsInUse(scene);
    return !materials.empty() && !scene.hook && std::ranges::none_of(scene.rig.numbers, ofMaterial) &&
           std::ranges::all_of(materials, [](const Material* material) { return isBlack(*material); });
}

bool anyScatters(const Scene& scene) {
    return std::ranges::any_of(scene.materials, [](const Material& material) {
        return subsurfaceOf(material, SubsurfaceMethod::TextureSpaceDiffusion) != SubsurfaceMethod::None;
    });
}

bool diffuses(const Scene& scene, const MeshInstance& instance, SubsurfaceRequest request) {
    return isDrawn(scene, instance) &&
           infoOf(subsurfaceOf(scene.materials[std::size_t(instance.material)], request)).diffuses;
}

bool anyDiffuses(const Scene& scene, SubsurfaceRequest request) {
    // Called often, for scenes with far more nodes than materials.
    const bool mayDo = std::ranges::any_of(
        scene.materials, [&](const Material& material) { return infoOf(subsurfaceOf(material, request)).diffuses; });
    return mayDo && std::ranges::any_of(scene.nodes, [&](const Node& node) {
               return std::ranges::any_of(
                   node.instances, [&](const MeshInstance& instance) { return diffuses(scene, instance, request); });
           });
}

} // namespace tessera::scenes
