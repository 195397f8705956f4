#pragma once
#include <string>
#include <vector>

#include "base/Picture.h"
#include "engine/Renderer.h"
#include "validation/pictures/HeatMap.h"

namespace tessera::validation {

/// The image of a rendered frame for saving: its display image, with a title and a legend for views that need them.
/// `shadows` are the frame's.
DisplayImage shownPicture(const engine::RenderedFrame& frame, const engine::DrawnShadows& shadows,
                          const std::string& sceneName, engine::Technique technique, frame::DebugView view);

/// The legend of a shadow map view: which maps each colour stands for, and why there are none. Empty for other views,
/// and for an atlas without maps.
std::vector<Swatch> shadowSwatches(frame::DebugView view, const engine::DrawnShadows& shadows);

} // namespace tessera::validation
