#pragma once
#include <vector>

#include "scenes/Scene.h"

/// The parts of a scene that are drawn. Files contain unused materials, meshes and images, which must not affect how a
/// frame is stored or drawn.
namespace tessera::scenes {

/// Whether an instance draws anything: its mesh has triangles.
bool isDrawn(const Scene& scene, const MeshInstance& instance);

/// The materials and meshes of instances that are drawn. An image is in use if a material in use references it.
struct InUse {
    std::vector<bool> materials; ///< by index
    std::vector<bool> meshes;    ///< by index
};
InUse inUse(const Scene& scene);

/// The materials in use, in the scene's order.
std::vector<const Material*> materialsInUse(const Scene& scene);

/// The meshes in use, in the scene's order.
std::vector<const Mesh*> meshesInUse(const Scene& scene);

/// Whether the factors of all materials in use make them black under any light, whatever their textures: no clip or
/// hook changes a material.
bool isAllBlack(const Scene& scene);

/// Whether any material has subsurface scattering; a request may change its method.
bool anyScatters(const Scene& scene);

/// Whether the subsurface method of an instance diffuses irradiance over its surface.
bool diffuses(const Scene& scene, const MeshInstance& instance, SubsurfaceRequest request);
/// Whether that of any instance does.
bool anyDiffuses(const Scene& scene, SubsurfaceRequest request);

} // namespace tessera::scenes
