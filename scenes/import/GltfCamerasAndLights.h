#pragma once
#include <glm/glm.hpp>

#include "scenes/import/GltfContext.h"

namespace tessera::scenes::gltf {

/// Adds the camera that glTF node `node` carries, if any; scale and shear of the transform are taken out. Cameras'
/// names are made unique, as programs choose by name. Throws InputError naming the camera.
void importCamera(Context& context, int node, const glm::dmat4& worldFromNode);

/// Adds the light that glTF node `node` carries, if any. Of the node's transform only the position and the orientation
/// count. Source: KHR_lights_punctual. Throws InputError naming the light.
void importLight(Context& context, int node, const glm::dmat4& worldFromNode);

} // namespace tessera::scenes::gltf
