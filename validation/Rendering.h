#pragma once
#include "base/Picture.h"
#include "passes/recipes/Renderer.h"

namespace tessera::validation {

/// Rendered frames as the pictures that are compared, written and shown.
Picture toPicture(const recipes::RenderedFrame& frame);
DisplayImage toDisplayImage(const recipes::RenderedFrame& frame);

} // namespace tessera::validation
