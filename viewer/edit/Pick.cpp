#include "viewer/edit/Pick.h"

#include <cassert>

#include "validation/reference/CameraRays.h"
#include "validation/reference/NormalAt.h"
#include "validation/reference/Objects.h"
#include "validation/reference/Visibility.h"

namespace tessera::viewer {
namespace {

/// The mesh instance with a number in document order, with the triangle.
std::optional<Pick> instanceNumbered(const scenes::Scene& scene, std::size_t number, std::size_t triangle) {
    for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
        const std::vector<scenes::MeshInstance>& instances = scene.nodes[node].instances;
        if (number >= instances.size()) {
            number -= instances.size();
            continue;
        }
        const scenes::MeshInstance& instance = instances[number];
        if (3 * triangle >= scene.meshes[std::size_t(instance.mesh)].indices.size()) return {};
        return Pick{int(node), int(number), instance.mesh, instance.material, int(triangle), {}, {}};
    }
    return {};
}

} // namespace

std::optional<Pick> pickedByRay(const scenes::Scene& scene, const scenes::Camera& camera, glm::ivec2 sizePixels,
                                glm::ivec2 pixel) {
    assert(pixel.x >= 0 && pixel.y >= 0 && pixel.x < sizePixels.x && pixel.y < sizePixels.y);
    const reference::CameraRays rays(camera, sizePixels);
    const reference::Textures textures(scene, reference::Filtering::Exact);
    const reference::Ray ray = rays.through(pixel.x, pixel.y);
    const reference::Objects objects(scene, rays, ray);
    const reference::Visibility visibility(objects, rays, textures);
    std::optional<reference::Hit> nearest = visibility.nearestOpaque(ray);
    const double behindMetres = nearest ? nearest->depthMetres : rays.farMetres();
    for (const reference::Hit& hit : visibility.transparentBefore(ray, behindMetres))
        if (!nearest || hit.depthMetres < nearest->depthMetres) nearest = hit;
    if (!nearest) return {};
    std::optional<Pick> pick = instanceNumbered(scene, nearest->object->number, nearest->triangle);
    if (!pick) return {};
    pick->positionWS = rays.eyeWS() + ray.at(nearest->depthMetres);
    pick->normalWS = reference::normalAt(*nearest, textures);
    return pick;
}

} // namespace tessera::viewer
