#pragma once
#include "scenes/Scene.h"

/// Meshes of the scene `studio`, in metres, standing on the origin unless stated otherwise.
namespace tessera::scenes::builtin::studio {

Mesh paperSweep();              ///< a floor that bends up into a wall behind, in world space
Mesh ball(double radiusMetres); ///< resting on the origin
Mesh drapedCloth();             ///< over a round table, in folds; 0.62 m high
Mesh vase();                    ///< 0.78 m high
Mesh ring();                    ///< a bracelet that lies flat
Mesh stopper();                 ///< a rounded cylinder
Mesh shell();                   ///< a smooth egg, lying, 0.44 m high
Mesh lampFoot();                ///< 0.1 m high

} // namespace tessera::scenes::builtin::studio
