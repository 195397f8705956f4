#pragma once
#include <optional>

#include "scenes/import/GltfContext.h"

namespace tessera::scenes::gltf {

/// The picture of glTF image `index`, named as the document names it. Nothing after a warning, which `instead` ends,
/// where it cannot be read; a load that is to be strict throws InputError with the same text.
std::optional<Image> readableImage(Context& context, int index, const char* instead);

} // namespace tessera::scenes::gltf
