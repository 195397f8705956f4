#pragma once
#include "scenes/Scene.h"

/// The hall's parts as meshes, each of one finish, metres. Parts of a side are made for the left side (x < 0) of a bay
/// whose middle is z = 0; turned by half a turn about Y they serve the right side.
namespace tessera::scenes::builtin::hall {

Mesh columnShaft(); ///< base and fluted shaft on the origin
Mesh columnPlinth();
Mesh columnCapital(); ///< bell, leaves and abacus

Mesh bayWalls();   ///< arcade, windows, outer wall with niche, aisle vault
Mesh bayTrim();    ///< mouldings, pilaster and rib
Mesh bayGilding(); ///< thin gilt lines

Mesh vaultFrames();   ///< the coffers' frames over the whole nave of a bay
Mesh vaultPanels();   ///< the coffers' grounds
Mesh vaultRosettes(); ///< a flower in each coffer

Mesh endWalls(); ///< both ends, in world space
Mesh endTrim();
Mesh apse(); ///< the half dome and its cylinder
Mesh portalDoors();

Mesh floor();
Mesh carpet();
Mesh dais();     ///< steps in the apse
Mesh banner();   ///< of the column at z = 0, left side
Mesh vase();     ///< on the origin, 1.15 m high
Mesh pedestal(); ///< on the origin, 0.45 m high, 0.6 m wide

/// The hollow behind an arched wall: half a cylinder with half a dome and a floor, open towards +Z, its axis X = Z = 0.
/// Its edge fits an ArchedWall of `slices` steps, an even number.
void appendAlcove(Mesh& mesh, double radius, double floorY, double springY, int slices);

} // namespace tessera::scenes::builtin::hall
