#pragma once
#include <string>
#include <vector>

#include "scenes/import/GltfDocument.h"

namespace tessera::scenes::gltf {

/// Brings the lights of a document from lumens to watts where it is in lumens: as the load asks, else as the exporter
/// is known to write them, which a note tells. Source: Blender's exporter, whose "Standard" lighting mode, the default,
/// writes 683 lumens for each watt; before its version 3.4 not for suns (glTF-Blender-IO, pull request 1760, October
/// 2022). Others' numbers are taken as they are.
void takeLightUnits(Document& document, std::vector<std::string>& notes);

} // namespace tessera::scenes::gltf
