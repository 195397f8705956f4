#pragma once
#include "scenes/Scene.h"

namespace tessera::viewer {

/// Rows for a light's path and its keyframes. Returns whether they changed it.
bool lightLifeRows(scenes::Light& light, double timeSeconds, double sceneSizeMetres);

} // namespace tessera::viewer
