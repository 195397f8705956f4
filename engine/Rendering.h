#pragma once
#include "base/Picture.h"
#include "engine/Renderer.h"

namespace tessera::engine {

/// Rendered frames as the pictures that are compared, written and shown.
Picture toPicture(const RenderedFrame& frame);
DisplayImage toDisplayImage(const RenderedFrame& frame);

/// Linear radiance with the exposure and tone map of the settings, as the display pass shows it: for pictures that no
/// pass drew, such as the reference's. NaN is black.
DisplayImage toDisplayImage(const Picture& picture, const frame::FrameSettings& settings);

} // namespace tessera::engine
