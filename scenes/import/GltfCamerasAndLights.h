#pragma once
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/import/GltfContext.h"

namespace tessera::scenes::gltf {

/// Adds the camera that glTF node `node` carries, if any; scale and shear of the transform are taken out. Cameras'
/// names are made unique, as programs choose by name. Throws InputError naming the camera.
void importCamera(Context& context, int node, const glm::dmat4& worldFromNode);

/// Adds the light that glTF node `node` carries, if any. Of the node's transform only the position and the orientation
/// count. Source: KHR_lights_punctual. Throws InputError naming the light.
void importLight(Context& context, int node, const glm::dmat4& worldFromNode);

/// Brings the lights of a document from lumens to watts where it is in lumens: as the load asks, else as the exporter
/// is known to write them, which a note tells. Source: Blender's exporter, whose "Standard" lighting mode, the default,
/// writes 683 lumens for each watt; before its version 3.4 not for suns (glTF-Blender-IO, pull request 1760, October
/// 2022). Others' numbers are taken as they are.
void takeLightUnits(Document& document, std::vector<std::string>& notes);

} // namespace tessera::scenes::gltf
