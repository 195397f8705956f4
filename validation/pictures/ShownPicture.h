#pragma once
#include <string>

#include "base/Picture.h"
#include "engine/Renderer.h"

namespace tessera::validation {

/// A rendered frame as it is saved to be looked at: what its display pass made of it, and of views that need one a
/// picture with a title and a legend.
DisplayImage shownPicture(const engine::RenderedFrame& frame, const std::string& sceneName, engine::Technique technique,
                          frame::DebugView view);

} // namespace tessera::validation
