#pragma once
#include <map>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/import/GltfContext.h"
#include "scenes/import/GltfHierarchy.h"
#include "scenes/import/GltfMaterials.h"

/// A document states thicknesses in the space of each mesh, the scene in metres of the world. Source:
/// KHR_materials_volume, "Properties".
namespace tessera::scenes::gltf {

/// Node-from-instance, by nodes of the document whose meshes are drawn several times.
using Instancing = std::map<int, std::vector<glm::dmat4>>;

/// `Context::thicknessScales`. What a skin moves is taken to be as large as its mesh.
std::map<int, std::optional<double>> thicknessScales(const Context& context, const std::vector<PlacedNode>& allPlaced,
                                                     const Instancing& instancing);

/// Makes the scene's materials as thick as the nodes that show them say. What clips say of them the rig scales.
void placeThicknesses(Context& context, const Materials& materials);

} // namespace tessera::scenes::gltf
