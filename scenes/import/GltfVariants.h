#pragma once
#include "scenes/import/GltfMaterials.h"

/// KHR_materials_variants.
namespace tessera::scenes::gltf {

/// Tells which variants there are, and imports the materials of the one that is asked for. Called after all others are
/// imported, so that these keep their numbers, by which scene files name them.
void importVariant(Context& context, Materials& materials);

/// Gives these materials to what shows them. Called when all instances are there.
void bindVariant(Context& context, Materials& materials);

} // namespace tessera::scenes::gltf
