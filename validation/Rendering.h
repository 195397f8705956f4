#pragma once
#include "passes/recipes/Renderer.h"
#include "validation/Picture.h"

namespace tessera::validation {

/// Rendered frames as the pictures that are compared, written and shown.
Picture toPicture(const recipes::RenderedFrame& frame);
DisplayImage toDisplayImage(const recipes::RenderedFrame& frame);

/// A linear picture as a display shows it without tone map: clamped, sRGB, 8 bits; for pictures that come from a file.
DisplayImage toDisplayImage(const Picture& picture);

} // namespace tessera::validation
