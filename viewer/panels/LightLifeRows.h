#pragma once
#include "scenes/Scene.h"

namespace tessera::viewer {

/// Rows of the way that a light goes and of its keyframes. Whether they changed it.
bool lightLifeRows(scenes::Light& light, double timeSeconds, double sceneSizeMetres);

} // namespace tessera::viewer
