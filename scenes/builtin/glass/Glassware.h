#pragma once
#include "scenes/Scene.h"

/// Meshes of the scene `glass`, in metres, standing on the origin. Visible inner surfaces come first, so that nearer
/// surfaces are drawn later.
namespace tessera::scenes::builtin::glass {

Mesh tableTop();    ///< top at y = 0
Mesh wineBottle();  ///< with its mouth closed, 0.28 m high
Mesh potBottle();   ///< squat, 0.17 m high
Mesh vase();        ///< open, 0.18 m high
Mesh tumbler();     ///< open, 0.095 m high
Mesh prism();       ///< lying along X, with a side of 0.07 m
Mesh crystalBall(); ///< on its foot
Mesh crystalFoot(); ///< a ring
Mesh pane();        ///< a square that faces +Z
Mesh paneHolder();  ///< a bar that the pane stands on
Mesh fruit();       ///< round
Mesh lampStand();   ///< a disk

inline constexpr double kHolderMetres = 0.012; ///< height, at which panes stand
inline constexpr double kFootMetres = 0.012;   ///< height of the crystal ball's foot

} // namespace tessera::scenes::builtin::glass
