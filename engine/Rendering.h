#pragma once
#include "base/Picture.h"
#include "engine/Renderer.h"

namespace tessera::engine {

/// Rendered frames as the pictures that are compared, written and shown.
Picture toPicture(const RenderedFrame& frame);
DisplayImage toDisplayImage(const RenderedFrame& frame);

} // namespace tessera::engine
