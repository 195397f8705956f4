#pragma once
#include "scenes/Scene.h"

/// Meshes of the reading hall, each of one finish, metres. Parts of a side are made for the right side (x > 0); turned
/// by half a turn about Y they serve the left side. Texture coordinates are metres, except for books (Textures.h).
namespace tessera::scenes::builtin::lamps {

// ---- Building.cpp ----

Mesh walls(); ///< including the window's reveal
Mesh ceiling();
Mesh beams();
Mesh floorBoards();
Mesh carpetRunner();
Mesh windowBars();
Mesh gallery(); ///< of a side: the slab
Mesh railing(); ///< of a side
Mesh pillar();  ///< on the origin, up to the gallery

// ---- Furniture.cpp ----

Mesh caseBoards();                  ///< boards of the case whose middle is z = 0
Mesh caseBooks(std::uint32_t seed); ///< books of that case
Mesh upperBoards();                 ///< of a side: shelves along the outer wall
Mesh upperBooks();                  ///< of a side: books on these shelves
Mesh desk();                        ///< on the origin, 2.6 m along Z
Mesh benches();                     ///< beside the desk
Mesh deskLampStands();              ///< of all lamps of a desk
Mesh deskLampShades();              ///< of all lamps of a desk
Mesh papers();                      ///< on the desk
Mesh luminaires();                  ///< frames and rods over both sides
Mesh fixtures();                    ///< of a side: mounts of the strips over the gallery

} // namespace tessera::scenes::builtin::lamps
