#include "scenes/InUse.h"

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

} // namespace

bool isDrawn(const Scene& scene, const MeshInstance& instance) {
    return !scene.meshes[static_cast<std::size_t>(instance.mesh)].indices.empty();
}

InUse inUse(const Scene& scene) {
    InUse used{std::vector<bool>(scene.materials.size()), std::vector<bool>(scene.meshes.size())};
    for (const Node& node : scene.nodes) {
        for (const MeshInstance& instance : node.instances) {
            if (!isDrawn(scene, instance)) continue;
            used.materials[static_cast<std::size_t>(instance.material)] = true;
            used.meshes[static_cast<std::size_t>(instance.mesh)] = true;
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

} // namespace tessera::scenes
