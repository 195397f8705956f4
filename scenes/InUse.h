#pragma once
#include <vector>

#include "scenes/Scene.h"

/// What of a scene is drawn. Files carry spare materials, meshes and pictures; nothing that decides how a frame is
/// stored or drawn may look at those.
namespace tessera::scenes {

/// Whether an instance draws anything: its mesh has triangles.
bool isDrawn(const Scene& scene, const MeshInstance& instance);

/// Whether each material and mesh belongs to an instance that is drawn. A picture is in use where a material in use
/// has it in a slot.
struct InUse {
    std::vector<bool> materials; ///< by index
    std::vector<bool> meshes;    ///< by index
};
InUse inUse(const Scene& scene);

/// The materials in use, in the scene's order.
std::vector<const Material*> materialsInUse(const Scene& scene);

/// The meshes in use, in the scene's order.
std::vector<const Mesh*> meshesInUse(const Scene& scene);

/// Whether any material has subsurface scattering, of which a request may choose another method.
bool anyScatters(const Scene& scene);

/// Whether light spreads over what an instance draws.
bool spreads(const Scene& scene, const MeshInstance& instance, SubsurfaceRequest request);
/// Whether it does over any.
bool anySpreads(const Scene& scene, SubsurfaceRequest request);

} // namespace tessera::scenes
