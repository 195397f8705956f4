#pragma once
#include <vector>

#include <glm/glm.hpp>

#include "scenes/import/GltfContext.h"

namespace tessera::scenes::gltf {

/// Node-from-instance of every instance of a node's mesh (EXT_mesh_gpu_instancing); none where the node has no such
/// extension. Throws InputError naming the attribute that is of the wrong type, of another number than the others, or
/// no transform.
std::vector<glm::dmat4> instanceTransforms(Context& context, int node);

} // namespace tessera::scenes::gltf
