#pragma once
#include "scenes/Scene.h"

namespace tessera::scenes::builtin::hall {

/// Indices of the hall's materials in its scene.
struct Finishes {
    int floor;
    int wall;
    int trim;
    int column;
    int plinth;
    int gold;
    int coffer;
    int mosaic;
    int carpet;
    int crimson;
    int azure;
    int bronze;
    int statue;
    int glaze;
    int door;
};

/// Adds the materials and draws their textures.
Finishes addFinishes(Scene& scene);

} // namespace tessera::scenes::builtin::hall
