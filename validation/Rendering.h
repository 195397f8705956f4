#pragma once
#include "passes/recipes/Renderer.h"
#include "validation/Picture.h"

namespace tessera::validation {

/// Rendered frames as the pictures that are compared, written and shown.
Picture toPicture(const recipes::RenderedFrame& frame);
DisplayImage toDisplayImage(const recipes::RenderedFrame& frame);

} // namespace tessera::validation
