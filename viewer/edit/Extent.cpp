#include "viewer/edit/Extent.h"

#include <algorithm>

#include "scenes/AreaLight.h"

namespace tessera::viewer {

scenes::Box3 boundsOfMaterial(const scenes::Scene& scene, int material) {
    scenes::Box3 boundsWS;
    const std::vector<glm::dmat4> worldFromNode = scenes::worldFromNodes(scene);
    for (std::size_t node = 0; node < scene.nodes.size(); ++node)
        for (const scenes::MeshInstance& instance : scene.nodes[node].instances) {
            if (instance.material != material) continue;
            for (const glm::vec3& positionOS : scene.meshes[std::size_t(instance.mesh)].positionsOS)
                boundsWS.extend(glm::dvec3(worldFromNode[node] * glm::dvec4(glm::dvec3(positionOS), 1.0)));
        }
    return boundsWS;
}

scenes::Box3 boundsOfLight(const scenes::Light& light, double timeSeconds, double leastMetres) {
    if (!scenes::infoOf(light.type).hasPosition()) return {};
    const scenes::Light shown = scenes::lightAtTime(light, timeSeconds);
    const double metres = std::max(scenes::surfaceReachMetres(shown), leastMetres);
    return {shown.positionWS - metres, shown.positionWS + metres};
}

} // namespace tessera::viewer
