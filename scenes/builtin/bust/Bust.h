#pragma once
#include "scenes/Scene.h"

/// The bust as a mesh and as textures on it. Texture coordinates are 0..1 around (u, the seam at the back) and upwards
/// (v = 1 at the bottom).
namespace tessera::scenes::builtin {

struct Bust {
    Mesh mesh;       ///< smooth: vertex normals without the fine relief
    Image normalMap; ///< object-space normals (2 texel - 1) with the fine relief, 16 bits per channel
    Image albedoMap; ///< sRGB
};

/// What the bust is made of.
enum class BustPaint { WeatheredMarble, PolishedMarble, Skin };

/// Linear colour of polished marble between its veins.
inline constexpr glm::dvec3 kPolishedMarble(0.80, 0.785, 0.755);

/// The bust standing on y = 0, `heightMetres` high, its front towards +Z, with maps of `mapTexels` squared.
Bust makeBust(int columns, int rows, double heightMetres, int mapTexels, BustPaint paint);

/// The bust without maps, for uses at a small size.
Mesh bustMesh(int columns, int rows, double heightMetres);

} // namespace tessera::scenes::builtin
