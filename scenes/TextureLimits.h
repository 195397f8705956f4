#pragma once
#include <string>

#include "scenes/Scene.h"

namespace tessera::scenes {

class LoadLedger;

/// The most texels a side that every driver takes. Source: OpenGL 4.5 core, table 23.53, MAX_TEXTURE_SIZE.
inline constexpr int kMostTextureSide = 16384;

/// Averages images of textures that have more texels a side, clamps texture coordinates to kMostTextureNumber, and
/// reduces transforms by which they name texels beyond 2^30. Scene::warnings names what changed; `source` is the file,
/// or the scene. Throws InputError instead where the load is strict.
void keepTextureLimits(Scene& scene, const std::string& source, LoadLedger& ledger);

} // namespace tessera::scenes
