#pragma once
#include <string>
#include <vector>

#include "base/Picture.h"
#include "engine/Renderer.h"
#include "validation/pictures/HeatMap.h"

namespace tessera::validation {

/// A rendered frame, with its shadows, as it is saved to be looked at: what its display pass made of it, and of views
/// that need one a picture with a title and a legend.
DisplayImage shownPicture(const engine::RenderedFrame& frame, const engine::DrawnShadows& shadows,
                          const std::string& sceneName, engine::Technique technique, frame::DebugView view);

/// The legend of a view of shadow maps, by colours: which maps each stands for, and why there is none. Empty for other
/// views, and of an atlas without maps.
std::vector<Swatch> shadowSwatches(frame::DebugView view, const engine::DrawnShadows& shadows);

} // namespace tessera::validation
