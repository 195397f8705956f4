#pragma once
#include "scenes/import/GltfContext.h"

/// The light of EXT_lights_image_based that a document's scene names, as the scene's environment.
namespace tessera::scenes::gltf {

/// The six faces of the level that is not filtered, turned by the light's rotation, resampled in latitude and
/// longitude: four times as wide as a face. Filtered levels are not read, since they are made anew. A face that cannot
/// be read is a stand-in, with a warning; a note tells where the document's irradiance is not that of its faces.
void importEnvironment(Context& context);

} // namespace tessera::scenes::gltf
