#pragma once
#include <string>

#include "scenes/Scene.h"

namespace tessera::scenes {

class LoadLedger;

/// Maximum side of textures that every driver supports. Source: OpenGL 4.5 core, table 23.53, MAX_TEXTURE_SIZE.
inline constexpr int kMostTextureSide = 16384;

/// Averages textures larger than kMostTextureSide, clamps texture coordinates to kMostTextureNumber, and reduces
/// transforms that address texels beyond +-2^29. Scene::warnings lists the changes; `source` is the file, or the scene.
/// Throws InputError instead if the load is strict.
void keepTextureLimits(Scene& scene, const std::string& source, LoadLedger& ledger);

} // namespace tessera::scenes
