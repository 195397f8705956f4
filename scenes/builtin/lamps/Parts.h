#pragma once
#include "scenes/Scene.h"

/// The reading hall's parts as meshes, each of one finish, metres. Parts of a side are made for the right side (x > 0);
/// turned by half a turn about Y they serve the left side. Texture coordinates are metres, but of books (Textures.h).
namespace tessera::scenes::builtin::lamps {

// ---- Building.cpp ----

Mesh walls(); ///< and what frames the window
Mesh ceiling();
Mesh beams();
Mesh floorBoards();
Mesh carpetRunner();
Mesh windowBars();
Mesh gallery(); ///< of a side: the slab
Mesh railing(); ///< of a side
Mesh pillar();  ///< on the origin, up to the gallery

// ---- Furniture.cpp ----

Mesh caseBoards();                  ///< of the case whose middle is z = 0
Mesh caseBooks(std::uint32_t seed); ///< in it
Mesh upperBoards();                 ///< of a side: shelves along the outer wall
Mesh upperBooks();                  ///< on them
Mesh desk();                        ///< on the origin, 2.6 m along Z
Mesh benches();                     ///< beside it
Mesh deskLampStands();              ///< of all lamps of a desk
Mesh deskLampShades();              ///< the same
Mesh papers();                      ///< on it
Mesh luminaires();                  ///< frames and rods over both sides
Mesh fixtures();                    ///< of a side: what holds the strips over the gallery

} // namespace tessera::scenes::builtin::lamps
