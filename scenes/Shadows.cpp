#include "scenes/Shadows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/AreaLight.h"
#include "scenes/InUse.h"

namespace tessera::scenes {

bool castsShadow(const Scene& scene, std::size_t light, const ShadowRequest& request) {
    switch (request.kind) {
    case ShadowRequest::Kind::None:
        return false;
    case ShadowRequest::Kind::Scene:
        return scene.lights[light].castsShadow;
    case ShadowRequest::Kind::All:
        return true;
    case ShadowRequest::Kind::First:
        return light < std::size_t(request.lights);
    }
    return false;
}

double shadowRadiusMetres(const Light& light) {
    if (!infoOf(light.type).isArea || light.type == LightType::Disk || light.type == LightType::Sphere)
        return light.radiusMetres;
    return std::sqrt(largestSeenArea(light) / std::numbers::pi);
}

bool hasSize(const Light& light) {
    return infoOf(light.type).hasPosition() ? shadowRadiusMetres(light) > 0.0 : light.angularRadiusRadians > 0.0f;
}

bool castsShadow(const Material& material) {
    return material.castsShadow && !isTransparent(material);
}

bool isCaster(const Scene& scene, const MeshInstance& instance) {
    return isDrawn(scene, instance) && instance.castsShadow &&
           castsShadow(scene.materials[std::size_t(instance.material)]);
}

CasterCounts casterCounts(const Scene& scene) {
    CasterCounts counts;
    for (const Node& node : scene.nodes) {
        for (const MeshInstance& instance : node.instances) {
            if (isCaster(scene, instance))
                counts.triangles += scene.meshes[std::size_t(instance.mesh)].indices.size() / 3;
            else if (isDrawn(scene, instance))
                counts.transparent += isTransparent(scene.materials[std::size_t(instance.material)]);
        }
    }
    return counts;
}

bool hasCasters(const Scene& scene) {
    return std::ranges::any_of(scene.nodes, [&](const Node& node) {
        return std::ranges::any_of(node.instances,
                                   [&](const MeshInstance& instance) { return isCaster(scene, instance); });
    });
}

} // namespace tessera::scenes
